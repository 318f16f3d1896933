#include "tests/support/oracle/text.hpp"

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace atlasgauge::oracle {
namespace {

constexpr const char* kBlanks = " \t\r\v\f";

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string without_comment(const std::string& text) {
  for (const Word& word : word_ranges(text)) {
    if (text[word.begin] == '#') return text.substr(0, word.begin);
  }
  return text;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool only_digits(const std::string& text) {
  return text.find_first_not_of("0123456789") == std::string::npos;
}

// "1.#INF00" and "1.#INF00e+000" are how old runtimes print infinity with two digits.
bool is_msvc_special(const std::string& text, const std::string& special) {
  return text.starts_with(special) &&
         text.find_first_not_of("0eE+", special.size()) == std::string::npos;
}

std::optional<double> special_number(const std::string& word) {
  const bool negative = word.starts_with('-');
  const std::string text = negative || word.starts_with('+') ? word.substr(1) : word;
  const double sign = negative ? -1 : 1;
  if (lower(text) == "inf" || lower(text) == "infinity" || is_msvc_special(text, "1.#INF")) {
    return sign * std::numeric_limits<double>::infinity();
  }
  const bool is_nan = lower(text) == "nan" || is_msvc_special(text, "1.#IND") ||
                      is_msvc_special(text, "1.#QNAN") || is_msvc_special(text, "1.#SNAN");
  if (is_nan) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

template <class Number>
Number parse_number(const Statement& statement, const std::string& word,
                    Number (*convert)(const char*, char**)) {
  if (const auto special = special_number(word)) return static_cast<Number>(*special);
  char* end = nullptr;
  const Number value = convert(word.c_str(), &end);
  const bool plain = word.find_first_not_of("0123456789+-.eE") == std::string::npos;
  if (word.empty() || !plain || *end != '\0') fail(statement, "not a number: " + word);
  return value;
}

}  // namespace

std::vector<Word> word_ranges(const std::string& text) {
  std::vector<Word> words;
  size_t begin = text.find_first_not_of(kBlanks);
  while (begin != std::string::npos) {
    const size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    words.push_back({begin, end});
    begin = text.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (const Word& word : word_ranges(text)) {
    words.push_back(text.substr(word.begin, word.end - word.begin));
  }
  return words;
}

std::vector<Statement> read_statements(const std::string& path, Backslash backslash) {
  std::istringstream text(read_file(path));
  std::vector<Statement> statements;
  std::string line, joined;
  size_t number = 0, first_number = 1;
  while (std::getline(text, line)) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const bool continues =
        backslash == Backslash::kContinues && !line.empty() && line.back() == '\\';
    if (continues) line.back() = ' ';
    joined += line;
    if (continues && text.peek() != std::istringstream::traits_type::eof()) continue;
    const std::string body = trimmed(without_comment(joined));
    const std::string keyword = body.substr(0, body.find_first_of(kBlanks));
    if (!body.empty()) {
      statements.push_back({first_number, keyword, trimmed(body.substr(keyword.size()))});
    }
    joined.clear();
    first_number = number + 1;
  }
  return statements;
}

void fail(const Statement& statement, const std::string& what) {
  throw std::runtime_error("line " + std::to_string(statement.line) + ": " + what);
}

double parse_double(const Statement& statement, const std::string& word) {
  return parse_number<double>(statement, word, strtod);
}

float parse_float(const Statement& statement, const std::string& word) {
  return parse_number<float>(statement, word, strtof);
}

std::optional<int64_t> parse_index(const Statement& statement, const std::string& word) {
  const bool has_sign = word.starts_with('-') || word.starts_with('+');
  const std::string digits = has_sign ? word.substr(1) : word;
  if (digits.empty() || !only_digits(digits)) fail(statement, "not an index: " + word);
  errno = 0;
  const long long value = std::strtoll(word.c_str(), nullptr, 10);
  if (errno == ERANGE) return std::nullopt;
  return value;
}

}  // namespace atlasgauge::oracle
