#include "stream/engine/pair_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace atlasgauge {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(PairSumTest, KeepsWhatRoundingTakes) {
  PairSum sum(1);
  EXPECT_TRUE(sum.add(0x1p-60));
  EXPECT_EQ(sum.high(), 1);
  EXPECT_EQ(sum.low(), 0x1p-60);
  EXPECT_TRUE(sum.add(-1));
  EXPECT_EQ(sum.value(), 0x1p-60);
}

TEST(PairSumTest, RefusesWhatItHasNoRoomFor) {
  PairSum sum(1);
  ASSERT_TRUE(sum.add(0x1p-60));
  EXPECT_FALSE(sum.add(0x1p-200));
  EXPECT_EQ(sum.high(), 1);
  EXPECT_EQ(sum.low(), 0x1p-60);
}

TEST(PairSumTest, RefusesWhatIsNotFinite) {
  PairSum sum(1);
  EXPECT_FALSE(sum.add(kInf));
  EXPECT_FALSE(sum.add(std::nan("")));
  EXPECT_EQ(sum.value(), 1);
  EXPECT_FALSE(PairSum(kInf).add(1));
}

TEST(PairSumTest, RefusesToOverflow) {
  PairSum sum(std::numeric_limits<double>::max());
  EXPECT_FALSE(sum.add(0x1p1023));
}

TEST(QuickSumTest, IsExactWherePairsAreNot) {
  QuickSum sum;
  for (const double term : {1.0, 0x1p-60, 0x1p-200, -1.0, -0x1p-60}) sum.add(term);
  EXPECT_EQ(sum.value(), 0x1p-200);
}

TEST(QuickSumTest, IsNotANumberWithATermThatIsNotFinite) {
  QuickSum sum;
  sum.add(kInf);
  EXPECT_TRUE(std::isnan(sum.value()));
}

TEST(QuickSumTest, AgreesWithTheExactSum) {
  std::mt19937 random(1);
  for (const int exponents : {0, 30, 100, 2000}) {
    QuickSum quick;
    ExactSum exact;
    for (int i = 0; i < 1000; ++i) {
      const double fraction = std::uniform_real_distribution<double>(-1, 1)(random);
      const double term = std::ldexp(
          fraction, std::uniform_int_distribution<int>(-exponents / 2, exponents / 2)(random));
      quick.add(term);
      exact.add(term);
      ASSERT_EQ(quick.value(), exact.value());
    }
  }
}

}  // namespace
}  // namespace atlasgauge
