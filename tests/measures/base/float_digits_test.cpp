#include "measures/base/float_digits.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace atlasgauge {
namespace {

TEST(FloatDigitsTest, AreThoseOfTheFloat) {
  EXPECT_EQ(double_of_digits(0.1F), 0.1);
  EXPECT_EQ(double_of_digits(-1e-30F), -1e-30);
  EXPECT_EQ(double_of_digits(0), 0.0);
  EXPECT_EQ(double_of_digits(16777216), 16777216.0);
}

TEST(FloatDigitsTest, GiveTheSameFloatBack) {
  std::mt19937 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(static_cast<float>(double_of_digits(value)), value);
  }
}

TEST(FloatDigitsTest, WhatIsNotFiniteStaysSo) {
  EXPECT_TRUE(std::isnan(double_of_digits(std::numeric_limits<float>::quiet_NaN())));
  EXPECT_EQ(double_of_digits(std::numeric_limits<float>::infinity()),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace atlasgauge
