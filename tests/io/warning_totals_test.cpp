#include "io/warning_totals.hpp"

#include <gtest/gtest.h>

namespace atlasgauge {
namespace {

TEST(WarningTotalsTest, TheLineNamesEveryKind) {
  EXPECT_EQ(warnings_line({{"faces invalid", 12}, {"no image", 1}}),
            "warnings: 12 faces invalid, 1 no image\n");
  EXPECT_EQ(warnings_line({}), "");
  EXPECT_EQ(warnings_line({{"faces invalid", 0}}), "");
}

TEST(WarningTotalsTest, TheLineIsReadBackFromTheEndOfAText) {
  const WarningTotals totals{{"faces invalid", 12}, {"no image", 1}};
  EXPECT_EQ(read_warnings_line(warnings_line(totals)), totals);
  EXPECT_EQ(read_warnings_line("warnings: 3 x\nwarning: a, 5 b\n" + warnings_line(totals)), totals);
}

TEST(WarningTotalsTest, OtherTextHasNone) {
  EXPECT_TRUE(read_warnings_line("").empty());
  EXPECT_TRUE(read_warnings_line("all is well\n").empty());
  EXPECT_TRUE(read_warnings_line("five warnings: 3 x\n").empty());
  EXPECT_TRUE(read_warnings_line("warnings: , x, 5, 5 \n").empty());
}

}  // namespace
}  // namespace atlasgauge
