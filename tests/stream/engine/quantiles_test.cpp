#include "stream/engine/quantiles.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include "io/error.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

using Samples = std::vector<Sample>;

constexpr std::size_t kCount = Quantiles::kPercents.size();

__extension__ typedef __int128 Int128;

/// Weights as integers: in units of the last bit of the lightest, which are exact for all weights
/// used here.
class ExactWeight {
 public:
  explicit ExactWeight(const Samples& samples) {
    for (const Sample& sample : samples) {
      if (sample.weight > 0) lightest_ = std::min(lightest_, std::ilogb(sample.weight));
    }
  }
  Int128 of(double weight) const {
    if (weight == 0) return 0;
    const int exponent = std::ilogb(weight);
    const auto mantissa = static_cast<std::int64_t>(std::scalbn(weight, 52 - exponent));
    return static_cast<Int128>(mantissa) << (exponent - lightest_);
  }

 private:
  int lightest_ = 1024;
};

/// Percentiles from the definition, over the samples in the given order.
template <class Less>
std::array<double, kCount> naive(Samples samples, Less less) {
  std::sort(samples.begin(), samples.end(),
            [&](const Sample& a, const Sample& b) { return less(a.value, b.value); });
  const ExactWeight weight(samples);
  Int128 total = 0;
  for (const Sample& sample : samples) total += weight.of(sample.weight);
  std::array<double, kCount> values;
  values.fill(std::nan(""));
  if (total == 0) return values;
  Int128 sum = 0;
  std::size_t next = 0;
  for (const Sample& sample : samples) {
    sum += weight.of(sample.weight);
    while (next < kCount && 100 * sum >= Quantiles::kPercents[next] * total) {
      values[next++] = sample.value;
    }
  }
  return values;
}

Quantiles select(TestEngine& engine, const Samples& samples) {
  SampleStore store(engine.scratch);
  {
    std::vector<SampleStore::Writer> writers;
    for (std::size_t i = 0; i < engine.workers.count(); ++i) writers.emplace_back(store);
    for (std::size_t i = 0; i < samples.size(); ++i) writers[i % writers.size()].push(samples[i]);
    for (auto& writer : writers) writer.flush();
  }
  return store.finish().select(engine);
}

void expect_same(const std::array<double, kCount>& found,
                 const std::array<double, kCount>& expected, const char* which) {
  for (std::size_t i = 0; i < kCount; ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(found[i])) << which << Quantiles::kPercents[i];
    } else {
      EXPECT_EQ(found[i], expected[i]) << which << Quantiles::kPercents[i];
    }
  }
}

class QuantilesTest : public testing::TestWithParam<std::tuple<std::uint64_t, std::size_t>> {
 protected:
  void expect_quantiles(const Samples& samples) {
    const auto [kib, workers] = GetParam();
    TestEngine engine({.budget_bytes = (kib << 10) * workers, .workers = workers});
    const Quantiles found = select(engine, samples);
    expect_same(found.rising, naive(samples, std::less<>()), "rising ");
    expect_same(found.falling, naive(samples, std::greater<>()), "falling ");
    EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
  }
};
INSTANTIATE_TEST_SUITE_P(BudgetsAndWorkers, QuantilesTest,
                         testing::Combine(testing::Values(12, 40, 16384),
                                          testing::Values(1, 2, 3)));

/// The values 1 to 100, of the same weight: percentile q is q from below, 101 - q from above.
TEST_P(QuantilesTest, OneToAHundred) {
  Samples samples;
  for (int i = 100; i > 0; --i) samples.push_back({static_cast<double>(i), 0.25});
  expect_quantiles(samples);
  TestEngine engine;
  const Quantiles quantiles = select(engine, samples);
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(quantiles.rising[i], Quantiles::kPercents[i]);
    EXPECT_EQ(quantiles.falling[i], 101 - Quantiles::kPercents[i]);
  }
}

TEST_P(QuantilesTest, NoSamples) {
  expect_quantiles({});
}

TEST_P(QuantilesTest, OneSample) {
  expect_quantiles({{3.5, 2}});
}

TEST_P(QuantilesTest, OnlyZeroWeights) {
  expect_quantiles({{1, 0}, {2, 0}});
}

TEST_P(QuantilesTest, ManyZeroWeights) {
  Samples samples;
  for (int i = 0; i < 5000; ++i) samples.push_back({static_cast<double>(i), 0});
  expect_quantiles(samples);
  samples.push_back({2500.5, 1e-300});
  expect_quantiles(samples);
}

TEST_P(QuantilesTest, EqualValues) {
  expect_quantiles(Samples(5000, {2, 0.1}));
}

TEST_P(QuantilesTest, TwoValuesTiedAtAPercentile) {
  // 30 % of the weight lies at 1: percentile 30 is still 1, percentile 40 is 2.
  Samples samples(300, {1, 1});
  samples.insert(samples.end(), 700, {2, 1});
  expect_quantiles(samples);
  samples.push_back({2, 1e-12});
  expect_quantiles(samples);
}

TEST_P(QuantilesTest, TiesAtEveryPercentile) {
  Samples samples;
  for (int i = 0; i < 20000; ++i) samples.push_back({static_cast<double>(i * 7919 % 20000), 3});
  expect_quantiles(samples);
}

TEST_P(QuantilesTest, ContinuousValues) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> value(0, 3);
  std::uniform_real_distribution<double> weight(0, 1);
  Samples samples;
  for (int i = 0; i < 30000; ++i) samples.push_back({value(random), weight(random)});
  expect_quantiles(samples);
}

TEST_P(QuantilesTest, NearlyEqualValues) {
  Samples samples;
  for (int i = 0; i < 10000; ++i) {
    samples.push_back({1 + (i * 7919 % 10000) * 0x1p-52, static_cast<double>(1 + i % 3)});
  }
  expect_quantiles(samples);
}

TEST_P(QuantilesTest, FewValuesOfManySamples) {
  Samples samples;
  for (int i = 0; i < 30000; ++i) {
    samples.push_back({static_cast<double>(i % 13), static_cast<double>(i % 5)});
  }
  expect_quantiles(samples);
}

TEST_P(QuantilesTest, WholeRangeOfDoubles) {
  Samples samples;
  for (int i = -1074; i < 1024; ++i) {
    for (int k = 0; k < 3; ++k) samples.push_back({std::ldexp(1.0, i), 1.0 + k});
  }
  samples.push_back({0, 50});
  samples.push_back({-0.0, 50});
  expect_quantiles(samples);
}

TEST_P(QuantilesTest, HugeWeightRatios) {
  Samples samples;
  for (int i = 0; i < 600; ++i)
    samples.push_back({static_cast<double>(i), std::ldexp(1.0, -i / 10)});
  expect_quantiles(samples);
  std::reverse(samples.begin(), samples.end());
  for (Sample& sample : samples) sample.value = 600 - sample.value;
  expect_quantiles(samples);
}

TEST_P(QuantilesTest, OneHeavySampleAmongMany) {
  Samples samples;
  for (int i = 0; i < 20000; ++i) samples.push_back({static_cast<double>(i), 1e-10});
  samples.push_back({12345.5, 1});
  expect_quantiles(samples);
}

TEST_P(QuantilesTest, ScaleOfTheWeightsDoesNotMatter) {
  for (const double scale : {1e-300, 1.0, 1e300}) {
    Samples samples;
    for (int i = 0; i < 3000; ++i)
      samples.push_back({static_cast<double>(i % 100), scale * (1 + i % 7)});
    expect_quantiles(samples);
  }
}

TEST_P(QuantilesTest, MoreSamplesThanAreSortedAtOnce) {
  std::mt19937 random(2);
  std::exponential_distribution<double> value(1);
  Samples samples;
  for (int i = 0; i < 70000; ++i) samples.push_back({value(random), static_cast<double>(i % 11)});
  expect_quantiles(samples);
}

TEST(QuantilesBudgetTest, SelectionEndsInTheLeastMemoryThatIsNotRefused) {
  const auto select_in_least = [] {
    ::alarm(5);
    Samples samples;
    for (int i = 0; i < 5000; ++i) samples.push_back({static_cast<double>(i), 1});
    for (std::uint64_t bytes = 4096;; bytes += 512) {
      try {
        TestEngine engine({.budget_bytes = bytes, .workers = 1});
        std::exit(select(engine, samples).rising[5] == 2499 ? 0 : 1);
      } catch (const Error&) {  // refused: try a little more
      }
    }
  };
  EXPECT_EXIT(select_in_least(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace atlasgauge
