#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/file/descriptor.hpp"

namespace atlasgauge {

/// A regular file that gets its name when it is complete: until commit() it has none, so that
/// nothing is left of it, however the program ends. An older file of that name stays until then;
/// the new one has its owner and permissions. A symbolic link stays, and the file it names is
/// replaced.
///
/// On file systems without such files (NFS among them), commit() copies it, and needs the room for
/// both; only then can a kill (not a signal that asks) leave a file, .atlasgauge-*.
///
/// To be opened and committed while the program has no other threads. Throws Error(kResource).
class UnnamedFile {
 public:
  /// Refuses a `path` that names a pipe or a device: nothing can be replaced there.
  explicit UnnamedFile(const std::string& path);

  void append(std::string_view bytes);
  /// Thread-safe. Not together with append().
  void write_at(std::uint64_t offset, std::string_view bytes) const;

  /// On disk and under its name, or neither. Nothing may be written after that.
  void commit();

  const std::string& target() const { return target_; }

 private:
  bool link_over_target() const;
  void copy_over_target() const;

  std::string target_;
  Descriptor file_;
  bool can_be_linked_ = true;
};

}  // namespace atlasgauge
