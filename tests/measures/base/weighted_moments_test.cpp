#include "measures/base/weighted_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "measures/base/archive.hpp"

namespace atlasgauge {
namespace {

using Values = std::vector<std::pair<double, double>>;

WeightedMoments moments_of(const Values& values) {
  WeightedMoments moments;
  for (const auto& [value, weight] : values) moments.add(value, weight);
  return moments;
}

/// 1, 2, 4 with weights 1, 2, 1: mean 9/4, second moment 25/4, variance 19/16.
TEST(WeightedMomentsTest, SixHandWorkedNumbers) {
  const WeightedMoments moments = moments_of({{1, 1}, {2, 2}, {4, 1}});
  EXPECT_EQ(moments.smallest(), 1);
  EXPECT_EQ(moments.largest(), 4);
  EXPECT_EQ(moments.mean(), 2.25);
  EXPECT_EQ(moments.rms(), 2.5);
  EXPECT_EQ(moments.variance(), 1.1875);
  EXPECT_EQ(moments.standard_deviation(), std::sqrt(1.1875));
}

TEST(WeightedMomentsTest, OneValueHasNoVariance) {
  const WeightedMoments moments = moments_of({{0.1, 0.3}});
  EXPECT_EQ(moments.mean(), 0.1);
  EXPECT_NEAR(moments.variance(), 0, 1e-33);
  EXPECT_GE(moments.variance(), 0);
}

TEST(WeightedMomentsTest, EqualValuesHaveNextToNoVariance) {
  const WeightedMoments moments = moments_of(Values(1000, {1.0 / 3, 0.7}));
  EXPECT_EQ(moments.mean(), 1.0 / 3);
  EXPECT_LT(moments.variance(), 1e-30);
  EXPECT_GE(moments.variance(), 0);
}

TEST(WeightedMomentsTest, NothingHasNothing) {
  const WeightedMoments moments;
  for (const double value : {moments.smallest(), moments.largest(), moments.mean(), moments.rms(),
                             moments.variance(), moments.standard_deviation()}) {
    EXPECT_TRUE(std::isnan(value));
  }
}

TEST(WeightedMomentsTest, NoWeightHasARangeOnly) {
  const WeightedMoments moments = moments_of({{3, 0}, {5, 0}});
  EXPECT_EQ(moments.smallest(), 3);
  EXPECT_EQ(moments.largest(), 5);
  EXPECT_TRUE(std::isnan(moments.mean()));
  EXPECT_TRUE(std::isnan(moments.variance()));
}

TEST(WeightedMomentsTest, SmallNoiseOnOneKeepsItsVariance) {
  // x = 1 + 1e-9 k with k = -1, 0, 1: of the numbers as rounded to double, to full precision.
  const double low = 1 - 1e-9, high = 1 + 1e-9;
  WeightedMoments moments;
  for (int i = 0; i < 1000; ++i) {
    for (const double value : {low, 1.0, high}) moments.add(value, 0.125);
  }
  const double a = low - 1, b = high - 1;  // exact
  const double mean = (a + b) / 3;
  const double expected = (a * a + b * b) / 3 - mean * mean;
  EXPECT_NEAR(moments.variance() / expected, 1, 1e-12);
}

TEST(WeightedMomentsTest, ScaleOfTheWeightsDoesNotMatter) {
  const WeightedMoments light = moments_of({{1, 0x1p-300}, {2, 0x1p-299}, {4, 0x1p-300}});
  const WeightedMoments heavy = moments_of({{1, 0x1p300}, {2, 0x1p301}, {4, 0x1p300}});
  EXPECT_EQ(light.variance(), 1.1875);
  EXPECT_EQ(heavy.variance(), 1.1875);
}

TEST(WeightedMomentsTest, MergedPartsAreTheWhole) {
  std::mt19937 random(1);
  std::exponential_distribution<double> any(1);
  Values values;
  for (int i = 0; i < 500; ++i) values.emplace_back(any(random), any(random));
  const WeightedMoments whole = moments_of(values);
  WeightedMoments merged = moments_of({values.begin() + 123, values.end()});
  merged.merge(WeightedMoments());
  merged.merge(moments_of({values.begin(), values.begin() + 123}));
  EXPECT_EQ(merged.mean(), whole.mean());
  EXPECT_EQ(merged.rms(), whole.rms());
  EXPECT_EQ(merged.variance(), whole.variance());
  EXPECT_EQ(merged.smallest(), whole.smallest());
  EXPECT_EQ(merged.largest(), whole.largest());
}

TEST(WeightedMomentsTest, SavedAndLoadedIsTheSame) {
  WeightedMoments moments = moments_of({{1, 1}, {2, 2}, {4, 1}});
  Saver saver;
  saver(moments);
  WeightedMoments loaded;
  Loader loader(saver.bytes());
  loader(loaded);
  EXPECT_EQ(loaded.variance(), 1.1875);
  EXPECT_EQ(loaded.largest(), 4);
}

}  // namespace
}  // namespace atlasgauge
