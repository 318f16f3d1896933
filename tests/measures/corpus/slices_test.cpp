#include "measures/corpus/slices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace atlasgauge {
namespace {

using Seconds = std::vector<double>;
using Slices = std::vector<std::uint64_t>;

Seconds loads(const Seconds& seconds, std::uint64_t slices) {
  Seconds load(slices);
  const Slices slice_of = balanced_slices(seconds, slices);
  for (std::size_t i = 0; i < seconds.size(); ++i) load.at(slice_of[i]) += seconds[i];
  return load;
}

TEST(SlicesTest, TheLongestGoFirstToTheSliceWithLeast) {
  EXPECT_EQ(balanced_slices(Seconds{1, 7, 3, 3}, 2), (Slices{1, 0, 1, 1}));
  EXPECT_EQ(balanced_slices(Seconds{1, 1, 1, 1}, 2), (Slices{0, 1, 0, 1}));
}

TEST(SlicesTest, NoSliceHasMoreThanItsShareAndOneModel) {
  std::mt19937 random(5);
  std::exponential_distribution<double> length(0.1);
  Seconds seconds(1000);
  std::ranges::generate(seconds, [&] { return length(random); });
  const double share = std::accumulate(seconds.begin(), seconds.end(), 0.0) / 24;
  const Seconds load = loads(seconds, 24);
  EXPECT_LE(*std::ranges::max_element(load),
            std::max(share * 4 / 3, *std::ranges::max_element(seconds)));
  EXPECT_GT(*std::ranges::min_element(load), 0.9 * share);
}

TEST(SlicesTest, UsuallyASliceTakesAMinute) {
  EXPECT_EQ(usual_slices(Seconds{}), 1U);
  EXPECT_EQ(usual_slices(Seconds{0.1, 0.1}), 1U);
  EXPECT_EQ(usual_slices(Seconds(100, 30)), 50U);
  EXPECT_EQ(usual_slices(Seconds{5000, 1}), 2U) << "no more than models";
  EXPECT_EQ(usual_slices(Seconds(5000, 600)), 1000U) << "no more than arrays may have";
}

}  // namespace
}  // namespace atlasgauge
