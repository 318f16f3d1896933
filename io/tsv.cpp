#include "io/tsv.hpp"

#include <fmt/format.h>

#include "io/error.hpp"
#include "io/parsed_number.hpp"

namespace atlasgauge {
namespace {

/// Room for a path of 4096 bytes, escaped, and some fields more.
constexpr std::size_t kMostLineBytes = 16 << 10;

void append_escaped(std::string_view field, std::string& line) {
  for (const char c : field) {
    switch (c) {
      case '\t':
        line += "\\t";
        break;
      case '\n':
        line += "\\n";
        break;
      case '\r':
        line += "\\r";
        break;
      case '\\':
        line += "\\\\";
        break;
      default:
        line += c;
    }
  }
}

char unescaped(char c) {
  switch (c) {
    case 't':
      return '\t';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    default:
      return c;
  }
}

}  // namespace

std::string tsv_line(std::span<const std::string> fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (&field != fields.data()) line += '\t';
    append_escaped(field, line);
  }
  return line + '\n';
}

std::vector<std::string> tsv_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\t') {
      fields.emplace_back();
    } else if (line[i] == '\\' && i + 1 < line.size()) {
      fields.back() += unescaped(line[++i]);
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

TsvReader::TsvReader(const std::string& path)
    : path_(path), source_(open_byte_source(path)), lines_(*source_, kMostLineBytes) {}

bool TsvReader::next() {
  if (!lines_.next()) return false;
  if (lines_.number() == 1 && lines_.line().starts_with('#')) return next();
  if (lines_.is_cut()) refuse("the line is too long");
  fields_ = tsv_fields(lines_.line());
  return true;
}

const std::string& TsvReader::text(std::size_t i) const {
  if (i < fields_.size()) return fields_[i];
  refuse(fmt::format("{} fields where there should be more", fields_.size()));
}

template <class Number>
Number TsvReader::parsed(std::size_t i) const {
  const std::string& field = text(i);
  if (const auto number = parsed_number<Number>(field)) return *number;
  refuse(fmt::format("field {} is '{}', which is not the number that belongs there", i + 1, field));
}

std::uint64_t TsvReader::whole(std::size_t i) const {
  return parsed<std::uint64_t>(i);
}

std::int64_t TsvReader::integer(std::size_t i) const {
  return parsed<std::int64_t>(i);
}

double TsvReader::number(std::size_t i) const {
  return parsed<double>(i);
}

void TsvReader::refuse(const std::string& text) const {
  throw Error(ErrorKind::kInput, path_, lines_.number(),
              text + "; make the job anew with corpus plan");
}

}  // namespace atlasgauge
