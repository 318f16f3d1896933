#include "io/table_file.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <iterator>
#include <nlohmann/json.hpp>

#include "io/error.hpp"
#include "io/json/json_text.hpp"
#include "io/suffix.hpp"

namespace atlasgauge {
namespace {

void append_quoted(std::string_view text, std::string& line) {
  line += '"';
  for (const char c : text) {
    if (c == '"') line += '"';
    line += c;
  }
  line += '"';
}

/// The shortest digits that give the same bits back, with a point or an exponent.
void append_double(double value, std::string& line) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  const std::string_view text(digits.data(), end.ptr);
  line += text;
  if (text.find_first_of(".e") == std::string_view::npos) line += ".0";
}

/// Appends values as CSV fields.
struct CsvValues {
  std::string& line;

  void operator()(std::monostate) const {}
  void operator()(std::integral auto value) const {
    fmt::format_to(std::back_inserter(line), "{}", value);
  }
  void operator()(double value) const {
    if (std::isfinite(value)) append_double(value, line);
  }
  void operator()(std::string_view text) const {
    const bool plain = !text.empty() && text.find_first_of(",\"\r\n") == std::string_view::npos;
    plain ? void(line += text) : append_quoted(text, line);
  }
};

struct JsonValues {
  std::string& line;

  void operator()(std::monostate) const { line += "null"; }
  void operator()(std::integral auto value) const {
    fmt::format_to(std::back_inserter(line), "{}", value);
  }
  void operator()(double value) const {
    std::isfinite(value) ? append_double(value, line) : (*this)(std::monostate());
  }
  void operator()(std::string_view text) const { line += json_text(nlohmann::json(text)); }
};

}  // namespace

TableFormat table_format(const std::string& path) {
  if (has_suffix(path, ".csv")) return TableFormat::kCsv;
  if (has_suffix(path, ".jsonl") || has_suffix(path, ".ndjson")) return TableFormat::kJsonLines;
  throw Error(ErrorKind::kUsage, path, 0,
              "a table is CSV or JSON Lines by its name; let it end in .csv or in .jsonl");
}

TableFile::TableFile(const std::string& path, std::span<const std::string> columns)
    : format_(table_format(path)), file_(path) {
  for (const std::string& column : columns) {
    const bool first = keys_.empty();
    if (format_ == TableFormat::kJsonLines) {
      keys_.push_back((first ? "{" : ",") + json_text(nlohmann::json(column)) + ":");
      continue;
    }
    keys_.emplace_back(first ? "" : ",");
    line_ += keys_.back();
    CsvValues{line_}(column);
  }
  if (format_ == TableFormat::kCsv) file_.append(line_ + "\n");
}

void TableFile::append(std::span<const TableValue> row) {
  if (row.size() != keys_.size()) {
    throw Error(ErrorKind::kInternal,
                fmt::format("{} values for {} columns of a table", row.size(), keys_.size()));
  }
  line_.clear();
  for (std::size_t i = 0; i < row.size(); ++i) {
    line_ += keys_[i];
    format_ == TableFormat::kCsv ? std::visit(CsvValues{line_}, row[i])
                                 : std::visit(JsonValues{line_}, row[i]);
  }
  line_ += format_ == TableFormat::kCsv ? "\n" : "}\n";
  file_.append(line_);
}

}  // namespace atlasgauge
