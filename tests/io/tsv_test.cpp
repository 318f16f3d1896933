#include "io/tsv.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/input_error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Fields = std::vector<std::string>;

TEST(TsvTest, AnyBytesComeBack) {
  const Fields fields{"", "a\tb", "c\nd\r", "\\", "\\t", std::string("\0\xFF", 2), " "};
  const std::string line = tsv_line(fields);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  EXPECT_EQ(tsv_fields(line.substr(0, line.size() - 1)), fields);
}

TEST(TsvTest, PlainFieldsAreWrittenPlainly) {
  EXPECT_EQ(tsv_line(std::array<std::string, 3>{"3", "", "a b/c.obj"}), "3\t\ta b/c.obj\n");
}

TEST(TsvTest, ABackslashAtTheEndStandsForItself) {
  EXPECT_EQ(tsv_fields("a\\"), Fields{"a\\"});
}

TEST(TsvReaderTest, ReadsTypedFieldsAfterTheHeader) {
  const TempDir dir;
  TsvReader lines(dir.write("x.tsv", "#n\ti\td\ttext\n18446744073709551615\t-3\t0.5\tx\\ty\n"));
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.whole(0), 18446744073709551615U);
  EXPECT_EQ(lines.integer(1), -3);
  EXPECT_EQ(lines.number(2), 0.5);
  EXPECT_EQ(lines.text(3), "x\ty");
  EXPECT_FALSE(lines.next());
}

TEST(TsvReaderTest, AFieldThatIsNoNumberIsNamedWithItsLine) {
  const TempDir dir;
  const std::string path = dir.write("x.tsv", "#n\n1\n1x\n");
  TsvReader lines(path);
  ASSERT_TRUE(lines.next() && lines.next());
  EXPECT_TRUE(says(input_error_of([&] { lines.whole(0); }), path + ":3: field 1 is '1x'"));
}

TEST(TsvReaderTest, AMissingFieldIsAnError) {
  const TempDir dir;
  TsvReader lines(dir.write("x.tsv", "1\n"));
  ASSERT_TRUE(lines.next());
  EXPECT_TRUE(says(input_error_of([&] { lines.text(1); }), "1 fields where there should be more"));
}

TEST(TsvReaderTest, AnEndlessLineIsAnError) {
  const TempDir dir;
  TsvReader lines(dir.write("x.tsv", std::string(1 << 20, 'x')));
  EXPECT_TRUE(says(input_error_of([&] { lines.next(); }), "too long"));
}

}  // namespace
}  // namespace atlasgauge
