#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <utility>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {
namespace detail {

/// Merges runs of sorted records into one.
template <class T, class Less>
Spill<T> merge_runs(Scratch& scratch, std::vector<Spill<T>> runs, Less less) {
  struct Source {
    SpillReader<T> reader;
    T head;
  };
  std::vector<Source> sources;
  sources.reserve(runs.size());
  for (Spill<T>& run : runs) {
    Source source{SpillReader<T>(run, SpillReader<T>::Mode::kConsume), T{}};
    if (source.reader.read(source.head)) sources.push_back(std::move(source));
  }
  const auto later = [&](std::size_t a, std::size_t b) {
    return less(sources[b].head, sources[a].head);
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(later)> heads(later);
  for (std::size_t i = 0; i < sources.size(); ++i) heads.push(i);
  SpillWriter<T> merged(scratch);
  while (!heads.empty()) {
    const std::size_t first = heads.top();
    heads.pop();
    merged.push(sources[first].head);
    if (sources[first].reader.read(sources[first].head)) heads.push(first);
  }
  return merged.finish();
}

}  // namespace detail

/// Sorts a spill by merging sorted runs, in the memory that the budget has free (at least five
/// blocks). For the rare cases that need an order or hold one huge group; KeyedGroups is faster.
template <class T, class Less>
Spill<T> sort_spill(const Engine& engine, Spill<T> input, Less less) {
  const std::uint64_t block_bytes = engine.block_bytes();
  const Reservation memory = engine.budget.reserve_between(
      5 * block_bytes, 5 * block_bytes + input.size() * sizeof(T), "sorting records");
  const std::uint64_t run_records = (memory.bytes() - 2 * block_bytes) / sizeof(T);
  std::vector<Spill<T>> runs;
  {
    SpillReader<T> reader(input, SpillReader<T>::Mode::kConsume);
    std::vector<T> run(std::min<std::uint64_t>(run_records, input.size()));
    while (const std::size_t count = reader.read(run)) {
      std::sort(run.begin(), run.begin() + static_cast<std::ptrdiff_t>(count), less);
      SpillWriter<T> writer(engine.scratch);
      writer.append({run.data(), count});
      runs.push_back(writer.finish());
    }
  }
  const std::size_t fan_in = memory.bytes() / block_bytes - 1;
  while (runs.size() > 1) {
    std::vector<Spill<T>> merged;
    for (std::size_t begin = 0; begin < runs.size(); begin += fan_in) {
      const std::size_t end = std::min(runs.size(), begin + fan_in);
      std::vector<Spill<T>> some(
          std::make_move_iterator(runs.begin() + static_cast<std::ptrdiff_t>(begin)),
          std::make_move_iterator(runs.begin() + static_cast<std::ptrdiff_t>(end)));
      merged.push_back(detail::merge_runs(engine.scratch, std::move(some), less));
    }
    runs = std::move(merged);
  }
  return runs.empty() ? Spill<T>(engine.scratch) : std::move(runs.front());
}

}  // namespace atlasgauge
