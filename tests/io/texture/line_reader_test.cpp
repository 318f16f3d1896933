#include "io/texture/line_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/obj_text.hpp"

namespace atlasgauge {
namespace {

std::vector<std::string> lines_of(const std::string& text, std::size_t max_line_bytes = 100000) {
  TextSource source(text);
  LineReader reader(source, max_line_bytes);
  std::vector<std::string> lines;
  while (reader.next()) {
    lines.push_back(std::string(reader.line()) + (reader.is_cut() ? "..." : ""));
    EXPECT_EQ(reader.number(), lines.size());
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(LineReaderTest, LinesEndWithALineEndOrTheFile) {
  EXPECT_EQ(lines_of("a\n\nb"), (Lines{"a", "", "b"}));
  EXPECT_EQ(lines_of("a\n"), Lines{"a"});
  EXPECT_EQ(lines_of(""), Lines{});
}

TEST(LineReaderTest, LinesLongerThanTheBufferAreWhole) {
  const std::string a(10000, 'a');
  const std::string b(4096, 'b');
  EXPECT_EQ(lines_of(a + "\n" + b + "\n" + b), (Lines{a, b, b}));
}

TEST(LineReaderTest, OverlongLinesAreCut) {
  EXPECT_EQ(lines_of("abcd\nabc\nabcdefgh", 3), (Lines{"abc...", "abc", "abc..."}));
}

TEST(LineReaderTest, AMarkOfUtf8IsSkipped) {
  EXPECT_EQ(lines_of("\xEF\xBB\xBF"
                     "a\n\xEF\xBB\xBF"
                     "b"),
            (Lines{"a",
                   "\xEF\xBB\xBF"
                   "b"}));
}

}  // namespace
}  // namespace atlasgauge
