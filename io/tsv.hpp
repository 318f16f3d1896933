#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_source.hpp"
#include "io/texture/line_reader.hpp"

namespace atlasgauge {

/// A line of tab-separated fields, which may hold any bytes: a tab, line feed, carriage return or
/// backslash in a field is written as \t, \n, \r or \\ (as "Linear TSV" has it). With its line end.
std::string tsv_line(std::span<const std::string> fields);

/// The fields of a line without its line end. An unknown escape stands for the letter itself.
std::vector<std::string> tsv_fields(std::string_view line);

/// The lines of such a file that this program wrote, one after the other, in constant memory. A
/// first line that begins with # names the columns, and is passed over. Everything throws
/// Error(kInput) with file and line.
class TsvReader {
 public:
  explicit TsvReader(const std::string& path);

  /// Goes to the next line; false at the end.
  bool next();

  std::size_t size() const { return fields_.size(); }
  /// Field `i` of the line.
  const std::string& text(std::size_t i) const;
  std::uint64_t whole(std::size_t i) const;
  std::int64_t integer(std::size_t i) const;
  double number(std::size_t i) const;

  [[noreturn]] void refuse(const std::string& text) const;

 private:
  template <class Number>
  Number parsed(std::size_t i) const;

  std::string path_;
  std::unique_ptr<ByteSource> source_;
  LineReader lines_;
  std::vector<std::string> fields_;
};

}  // namespace atlasgauge
