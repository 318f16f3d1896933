#include "stream/engine/quantiles.hpp"

#include <bit>
#include <cmath>
#include <utility>

#include "stream/engine/block_visit.hpp"
#include "stream/engine/fixed_sum.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kTargets = 2 * Quantiles::kPercents.size();

std::uint64_t key_of(double value) {
  return std::bit_cast<std::uint64_t>(value + 0.0);
}

/// A stretch of keys that holds at least one quantile, cut into bins of 2^shift keys.
struct Interval {
  std::uint64_t first;
  std::uint64_t last;
  Int128 weight_below = 0;  ///< of all smaller keys
  Int128 weight = 0;        ///< of its own keys, once it is a single one
  unsigned shift = 0;
  std::size_t first_bin = 0;
  std::size_t bins = 0;

  bool contains(std::uint64_t key) const { return first <= key && key <= last; }
  std::size_t bin_of(std::uint64_t key) const { return first_bin + ((key - first) >> shift); }
};

/// What fell into a bin, and between which keys: often a single one, which ends the search there.
struct Bin {
  Int128 weight = 0;
  std::uint64_t samples = 0;
  std::uint64_t smallest = ~std::uint64_t{0};
  std::uint64_t largest = 0;

  void merge(const Bin& other) {
    weight += other.weight;
    samples += other.samples;
    smallest = std::min(smallest, other.smallest);
    largest = std::max(largest, other.largest);
  }
};

/// Selects all quantiles of one store together. A quantile is the key k for which
/// 100 W(< k) <= target < 100 W(<= k), with W in integers.
class Selection {
 public:
  Selection(const Engine& engine, Spill<Sample> samples, double heaviest)
      : engine_(engine), samples_(std::move(samples)), weight_(heaviest) {}

  Quantiles run(std::uint64_t smallest, std::uint64_t largest) {
    const std::size_t workers = engine_.workers.count();
    // Half of it holds at least two bins an interval, so that every pass narrows the intervals.
    const std::uint64_t least = workers * (kTargets * 4 * sizeof(Bin) + engine_.block_bytes());
    const std::uint64_t useful =
        workers * (kBins * sizeof(Bin) + engine_.block_bytes()) + kSortable * sizeof(KeyWeight);
    const Reservation memory =
        engine_.budget.reserve_between(least, std::max(least, useful), "selecting percentiles");
    const std::uint64_t bytes = memory.bytes() - workers * engine_.block_bytes();
    bins_ = std::min<std::uint64_t>(kBins, bytes / 2 / (workers * sizeof(Bin)));
    const std::uint64_t sortable = std::min(kSortable, bytes / 2 / sizeof(KeyWeight));

    intervals_ = {{smallest, largest}};
    std::uint64_t samples_left = samples_.size();
    while (samples_left > sortable && !(targets_set_ && all_single())) samples_left = refine();
    return sort_rest();
  }

 private:
  static constexpr std::size_t kBins = 1 << 14;
  /// Fewer samples than this are sorted; more are cheaper to narrow down first.
  static constexpr std::uint64_t kSortable = 1 << 16;

  struct KeyWeight {
    std::uint64_t key;
    Int128 weight;
    bool operator<(const KeyWeight& other) const { return key < other.key; }
  };

  bool all_single() const {
    return std::all_of(intervals_.begin(), intervals_.end(),
                       [](const Interval& i) { return i.first == i.last; });
  }

  void cut_into_bins() {
    const std::size_t each = bins_ / intervals_.size();
    std::size_t next = 0;
    for (Interval& interval : intervals_) {
      interval.shift = 0;
      while ((interval.last - interval.first) >> interval.shift >= each) ++interval.shift;
      interval.first_bin = next;
      interval.bins = ((interval.last - interval.first) >> interval.shift) + 1;
      next += interval.bins;
    }
  }

  const Interval* interval_of(std::uint64_t key) const {
    const auto after = std::upper_bound(
        intervals_.begin(), intervals_.end(), key,
        [](std::uint64_t k, const Interval& interval) { return k < interval.first; });
    if (after == intervals_.begin()) return nullptr;
    const Interval& interval = *std::prev(after);
    return interval.contains(key) ? &interval : nullptr;
  }

  template <class Use>
  void visit_samples(Use use) {
    visit_blocks(engine_, samples_, [&](std::size_t worker, std::size_t, auto samples) {
      for (const Sample& sample : samples) {
        const std::uint64_t key = key_of(sample.value);
        const Interval* interval = interval_of(key);
        if (interval != nullptr) use(worker, *interval, key, sample);
      }
    });
  }

  std::vector<Bin> histogram() {
    std::vector<std::vector<Bin>> of_worker(
        engine_.workers.count(),
        std::vector<Bin>(intervals_.back().first_bin + intervals_.back().bins));
    visit_samples(
        [&](std::size_t worker, const Interval& interval, std::uint64_t key, const Sample& sample) {
          of_worker[worker][interval.bin_of(key)].merge({weight_.of(sample.weight), 1, key, key});
        });
    for (std::size_t worker = 1; worker < of_worker.size(); ++worker) {
      for (std::size_t i = 0; i < of_worker[0].size(); ++i) {
        of_worker[0][i].merge(of_worker[worker][i]);
      }
    }
    return std::move(of_worker[0]);
  }

  /// Narrows the intervals to the bins that hold a quantile; returns the samples in them.
  std::uint64_t refine() {
    cut_into_bins();
    const std::vector<Bin> bins = histogram();
    if (!targets_set_) set_targets(bins);
    std::vector<Interval> narrowed;
    std::uint64_t samples = 0;
    for (const Interval& interval : intervals_) {
      Int128 below = interval.weight_below;
      for (std::size_t i = 0; i < interval.bins; ++i) {
        const Bin& bin = bins[interval.first_bin + i];
        if (holds_target(below, below + bin.weight)) {
          narrowed.push_back({bin.smallest, bin.largest, below, bin.weight});
          samples += bin.samples;
        }
        below += bin.weight;
      }
    }
    intervals_ = std::move(narrowed);
    return samples;
  }

  bool holds_target(Int128 below, Int128 up_to) const {
    const auto target =
        std::lower_bound(sorted_targets_.begin(), sorted_targets_.end(), 100 * below);
    return target != sorted_targets_.end() && *target < 100 * up_to;
  }

  template <class Weighted>
  void set_targets(const std::vector<Weighted>& all) {
    Int128 total = 0;
    for (const Weighted& part : all) total += part.weight;
    for (std::size_t i = 0; i < Quantiles::kPercents.size(); ++i) {
      targets_[2 * i] = Quantiles::kPercents[i] * total - 1;
      targets_[2 * i + 1] = (100 - Quantiles::kPercents[i]) * total;
    }
    sorted_targets_ = targets_;
    std::sort(sorted_targets_.begin(), sorted_targets_.end());
    targets_set_ = true;
  }

  /// What is left is little, or one key an interval: sort and walk.
  Quantiles sort_rest() {
    std::vector<KeyWeight> rest;
    if (targets_set_ && all_single()) {
      for (const Interval& interval : intervals_) rest.push_back({interval.first, interval.weight});
    } else {
      rest = collect();
      std::sort(rest.begin(), rest.end());
      if (!targets_set_) set_targets(rest);
    }
    return walk(rest);
  }

  std::vector<KeyWeight> collect() {
    std::vector<std::vector<KeyWeight>> of_worker(engine_.workers.count());
    visit_samples(
        [&](std::size_t worker, const Interval&, std::uint64_t key, const Sample& sample) {
          of_worker[worker].push_back({key, weight_.of(sample.weight)});
        });
    for (std::size_t worker = 1; worker < of_worker.size(); ++worker) {
      of_worker[0].insert(of_worker[0].end(), of_worker[worker].begin(), of_worker[worker].end());
    }
    return std::move(of_worker[0]);
  }

  Quantiles walk(const std::vector<KeyWeight>& rest) const {
    Quantiles quantiles;
    quantiles.rising.fill(std::numeric_limits<double>::quiet_NaN());
    quantiles.falling = quantiles.rising;
    Int128 below = 0;
    const Interval* interval = nullptr;
    for (const KeyWeight& entry : rest) {
      const Interval* of_entry = interval_of(entry.key);
      if (of_entry != std::exchange(interval, of_entry)) below = of_entry->weight_below;
      const Int128 up_to = below + entry.weight;
      for (std::size_t i = 0; i < kTargets; ++i) {
        if (100 * below > targets_[i] || targets_[i] >= 100 * up_to) continue;
        auto& list = i % 2 == 0 ? quantiles.rising : quantiles.falling;
        list[i / 2] = std::bit_cast<double>(entry.key);
      }
      below = up_to;
    }
    return quantiles;
  }

  const Engine& engine_;
  Spill<Sample> samples_;
  FixedScale weight_;
  std::size_t bins_ = 0;
  std::vector<Interval> intervals_;
  bool targets_set_ = false;
  std::array<Int128, kTargets> targets_{}, sorted_targets_{};
};

}  // namespace

SampleSet SampleSet::up_to(const Engine& engine, double cutoff, const OnCut& on_cut) const {
  const std::size_t workers = engine.workers.count();
  const Reservation memory = engine.budget.reserve(
      workers * (engine.block_bytes() + Partition<Sample>::staging_bytes(engine.block_bytes())) +
          engine.block_bytes(),
      "samples up to a cutoff");
  SampleStore kept(engine.scratch);
  std::vector<SampleStore::Writer> writers(workers, SampleStore::Writer(kept));
  visit_blocks(engine, samples_, [&](std::size_t worker, std::size_t, auto samples) {
    for (const Sample& sample : samples) {
      sample.value <= cutoff ? writers[worker].push(sample) : on_cut(worker, sample);
    }
  });
  for (SampleStore::Writer& writer : writers) writer.flush();
  return kept.finish();
}

Quantiles SampleSet::select(const Engine& engine) {
  const std::uint64_t smallest = key_of(std::min(smallest_, largest_));
  Selection selection(engine, std::move(samples_), heaviest_);
  return selection.run(smallest, key_of(largest_));
}

Distribution select_up_to(const Engine& engine, SampleSet samples, double cutoff,
                          const SampleSet::OnCut& on_cut) {
  if (samples.largest() <= cutoff) {
    const double largest = samples.largest();
    const Quantiles all = samples.select(engine);
    return {all, all, largest};
  }
  SampleSet kept = samples.up_to(engine, cutoff, on_cut);
  const double largest = kept.largest();
  return {samples.select(engine), kept.select(engine), largest};
}

}  // namespace atlasgauge
