#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Statements, words and numbers of OBJ and MTL files.
namespace atlasgauge::oracle {

struct Statement {
  size_t line;
  std::string keyword;
  std::string rest;
};

struct Word {
  size_t begin;
  size_t end;
};

// What a backslash at the end of a line means.
enum class Backslash { kContinues, kPlain };

// A line that continues is joined with the next, a blank between them.
std::vector<Statement> read_statements(const std::string& path, Backslash backslash);

std::vector<Word> word_ranges(const std::string& text);
std::vector<std::string> words_of(const std::string& text);

// Throws std::runtime_error that names the statement's line, as the parsers below do.
[[noreturn]] void fail(const Statement& statement, const std::string& what);

double parse_double(const Statement& statement, const std::string& word);
float parse_float(const Statement& statement, const std::string& word);

// nullopt names nothing: an index that does not fit 64 bits.
std::optional<int64_t> parse_index(const Statement& statement, const std::string& word);

}  // namespace atlasgauge::oracle
