#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "io/file/descriptor.hpp"
#include "io/file/unnamed_file.hpp"

namespace atlasgauge {

/// Throws Error(kResource) if `path` plainly cannot be written, so that a run does not find out at
/// its end. "-" always can.
void check_writable(const std::string& path);

/// A file written from its start to its end, of any length, that is there whole or not at all: see
/// UnnamedFile. "-" is standard output; it and anything that is not a regular file (a pipe, a
/// device) is written directly.
/// To be opened and committed while the program has no other threads. Throws Error(kResource).
class OutputFile {
 public:
  static constexpr std::size_t kBufferBytes = 64 << 10;

  explicit OutputFile(const std::string& path);

  void append(std::string_view text);

  /// Without it, nothing is left. Nothing may be appended after that.
  void commit();

 private:
  void write(std::string_view text);
  void flush();

  std::string target_;
  std::optional<UnnamedFile> file_;
  Descriptor special_;  ///< what is written to if there is no file_
  std::string buffer_;
};

/// Writes a whole file or none, as OutputFile does.
void write_file(const std::string& path, std::string_view text);

}  // namespace atlasgauge
