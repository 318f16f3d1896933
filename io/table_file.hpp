#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/file/output_file.hpp"

namespace atlasgauge {

/// Nothing is a missing value; so is a number that is not finite.
using TableValue =
    std::variant<std::monostate, std::uint64_t, std::int64_t, double, std::string_view>;

enum class TableFormat {
  kCsv,        ///< RFC 4180 with line feeds: missing is empty, an empty text is ""
  kJsonLines,  ///< an object a line: missing is null
};

/// By the suffix of the name: .csv, .jsonl or .ndjson. Throws Error(kUsage).
TableFormat table_format(const std::string& path);

/// A table of any length that is there whole or not at all: see OutputFile. Numbers are as in the
/// report, so that reading them gives the same bits back. A text that is not UTF-8 keeps its bytes
/// in CSV and gets replacement characters in JSON.
class TableFile {
 public:
  /// Throws Error(kUsage) for another suffix, Error(kResource) if it cannot be written.
  TableFile(const std::string& path, std::span<const std::string> columns);

  /// A value for each column.
  void append(std::span<const TableValue> row);

  void commit() { file_.commit(); }

 private:
  const TableFormat format_;
  std::vector<std::string> keys_;  ///< what goes before the values of a row
  OutputFile file_;
  std::string line_;
};

}  // namespace atlasgauge
