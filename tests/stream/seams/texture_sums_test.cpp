#include "stream/seams/texture_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "io/error.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

TextureSample sample(std::uint32_t slot, double length_3d, double discrepancy) {
  return {SlotId{slot}, 0, length_3d, discrepancy};
}

std::vector<TextureSeams> sums_of(const std::vector<TextureSample>& samples, std::size_t slots) {
  TestEngine engine;
  return records_of(sum_by_texture(engine, spill_of(engine, samples), slots));
}

TEST(TextureSumsTest, MeansAreWeightedByLength) {
  const auto sums = sums_of({sample(1, 1, 10), sample(0, 5, 7), sample(1, 3, 30)}, 2);
  ASSERT_EQ(sums.size(), 2U);
  EXPECT_EQ(sums[0].slot, SlotId{0});
  EXPECT_EQ(sums[0].edges, 1U);
  EXPECT_EQ(sums[0].length_3d, 5);
  EXPECT_EQ(sums[0].discrepancy, 7);
  EXPECT_EQ(sums[1].slot, SlotId{1});
  EXPECT_EQ(sums[1].edges, 2U);
  EXPECT_EQ(sums[1].length_3d, 4);
  EXPECT_EQ(sums[1].discrepancy, 25);
}

TEST(TextureSumsTest, TexturesWithoutSamplesAreLeftOut) {
  EXPECT_TRUE(sums_of({}, 3).empty());
  const auto sums = sums_of({sample(2, 1, 0)}, 4);
  ASSERT_EQ(sums.size(), 1U);
  EXPECT_EQ(sums[0].slot, SlotId{2});
  EXPECT_EQ(sums[0].discrepancy, 0);
}

TEST(TextureSumsTest, BitsDoNotDependOnTheOrderOfTheSamples) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-30, 30), part(0, 1);
  std::vector<TextureSample> samples;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    samples.push_back(sample(i % 3, std::pow(2, exponent(random)), 441 * part(random)));
  }
  const auto want = sums_of(samples, 3);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(samples.begin(), samples.end(), random);
    const auto got = sums_of(samples, 3);
    for (std::size_t slot = 0; slot < 3; ++slot) {
      EXPECT_EQ(got[slot].length_3d, want[slot].length_3d);
      EXPECT_EQ(got[slot].discrepancy, want[slot].discrepancy);
    }
  }
}

TEST(TextureSumsTest, LengthsOfAnyMagnitudeHaveAMean) {
  for (const double length : {1e-150, 1e-30, 1e30, 1e150}) {
    const auto sums = sums_of({sample(0, length, 10), sample(0, 3 * length, 30)}, 1);
    ASSERT_EQ(sums.size(), 1U);
    EXPECT_DOUBLE_EQ(sums[0].discrepancy, 25) << length;
  }
}

TEST(TextureSumsTest, SoManyTexturesNeedMemory) {
  TestEngine engine({.budget_bytes = 100'000});
  EXPECT_THROW(sum_by_texture(engine, spill_of(engine, std::vector<TextureSample>{}), 100'000),
               Error);
}

}  // namespace
}  // namespace atlasgauge
