#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/partition.hpp"
#include "stream/groups.hpp"

namespace atlasgauge {

/// Weighted percentiles of a set of samples; NaN where the set has no weight.
struct Quantiles {
  static constexpr std::array<int, 11> kPercents{1, 10, 20, 30, 40, 50, 60, 70, 80, 90, 99};

  /// The smallest value whose cumulative weight from below reaches the percentage of the total.
  std::array<double, kPercents.size()> rising;
  /// The largest value whose cumulative weight from above reaches it: where a falling function of
  /// the value is measured, its percentiles are the function of these.
  std::array<double, kPercents.size()> falling;
};

/// The percentiles of a distribution, and of what a cutoff leaves of it.
struct Distribution {
  Quantiles all;
  Quantiles kept;  ///< of the samples up to the cutoff; the same as `all` where none is cut
  double largest_kept = 0;  ///< 0 where there is none
};

/// Samples of one distribution, all in scratch, with the bounds that selection starts from.
class SampleSet {
 public:
  SampleSet(Spill<Sample> samples, double smallest, double largest, double heaviest)
      : samples_(std::move(samples)), smallest_(smallest), largest_(largest), heaviest_(heaviest) {}

  double largest() const { return largest_; }

  /// Hears of samples beyond a cutoff; any worker.
  using OnCut = std::function<void(std::size_t worker, const Sample& sample)>;
  /// A copy of the samples up to the cutoff.
  SampleSet up_to(const Engine& engine, double cutoff, const OnCut& on_cut) const;

  /// Exact: weights are summed as integers in units of 2^-62 of the heaviest, and the quantiles are
  /// elements of the data. Values are taken by the bits of the double, which for numbers that are
  /// not negative have the same order: a histogram over their range, then over the bins that hold a
  /// quantile, until what is left fits in memory and is sorted. Consumes the samples.
  Quantiles select(const Engine& engine);

 private:
  Spill<Sample> samples_;
  double smallest_, largest_, heaviest_;
};

/// The quantiles of all samples, and of those up to the cutoff.
Distribution select_up_to(const Engine& engine, SampleSet samples, double cutoff,
                          const SampleSet::OnCut& on_cut);

/// Takes the samples of one distribution, from all workers.
class SampleStore {
 public:
  explicit SampleStore(Scratch& scratch) : samples_(scratch) {}

  class Writer {
   public:
    explicit Writer(SampleStore& store) : store_(&store), writer_(store.samples_) {}
    void push(const Sample& sample) {
      smallest_ = std::min(smallest_, sample.value);
      largest_ = std::max(largest_, sample.value);
      heaviest_ = std::max(heaviest_, sample.weight);
      writer_.push(sample);
    }
    /// Not thread-safe.
    void flush() {
      writer_.flush();
      store_->smallest_ = std::min(store_->smallest_, smallest_);
      store_->largest_ = std::max(store_->largest_, largest_);
      store_->heaviest_ = std::max(store_->heaviest_, heaviest_);
    }

   private:
    SampleStore* store_;
    SharedSpill<Sample>::Writer writer_;
    double smallest_ = std::numeric_limits<double>::infinity();
    double largest_ = 0;
    double heaviest_ = 0;
  };

  /// After all writers were flushed; the store is empty then.
  SampleSet finish() { return {samples_.finish(), smallest_, largest_, heaviest_}; }

 private:
  SharedSpill<Sample> samples_;
  double smallest_ = std::numeric_limits<double>::infinity();
  double largest_ = 0;
  double heaviest_ = 0;
};

}  // namespace atlasgauge
