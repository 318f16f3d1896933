#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/partition.hpp"
#include "stream/engine/record_buffer.hpp"

namespace atlasgauge {

/// Keys [first, last) of a partition; bucket i holds the keys from first + i * keys_per_bucket.
struct KeyRanges {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  std::uint32_t keys_per_bucket = 1;

  std::size_t bucket_count() const {
    return std::max<std::size_t>(1, (last - first + keys_per_bucket - 1) / keys_per_bucket);
  }
  std::size_t bucket_of(std::uint32_t key) const { return (key - first) / keys_per_bucket; }
  std::pair<std::uint32_t, std::uint32_t> keys_of(std::size_t bucket) const {
    const std::uint64_t begin = first + std::uint64_t{bucket} * keys_per_bucket;
    return {static_cast<std::uint32_t>(begin),
            static_cast<std::uint32_t>(std::min<std::uint64_t>(last, begin + keys_per_bucket))};
  }
};

/// Groups records by key, out of core: they are distributed to key ranges, then each bucket gets a
/// counting sort in memory, all workers at once. A bucket too large for its worker's memory is
/// distributed again by narrower ranges; a single key with more records than memory is handed over
/// as a Spill. Distribution plus counting sort was the fastest of the methods measured, and unlike
/// a merge its cost does not depend on how the keys interleave.
///
/// `Record` has key(). Groups come in no particular order, their records neither.
template <class Record>
class KeyedGroups {
 public:
  /// A number of buckets for plan() and distribute(): workers then end at about the same time.
  static std::uint64_t even_buckets(const Engine& engine) { return 4 * engine.workers.count(); }

  /// Called by worker threads, one group at a time each; the records may be reordered in place.
  using OnGroup = std::function<void(std::size_t worker, std::span<Record> group)>;
  /// Called by the calling thread when no worker is busy.
  using OnHotKey = std::function<void(std::uint32_t key, Spill<Record> records)>;

  /// Plans for about `records` of keys below `key_end`; `memory_bytes` will be free for the
  /// processing, `distribution_bytes` for the writing. `least_buckets`, as far as memory goes, are
  /// for groups that are long in work rather than in records: workers take a bucket at a time.
  static KeyRanges plan(const Engine& engine, std::uint64_t records, std::uint32_t key_first,
                        std::uint32_t key_end, std::uint64_t memory_bytes,
                        std::uint64_t distribution_bytes, std::uint64_t least_buckets = 1) {
    const std::uint64_t worker_bytes =
        std::clamp<std::uint64_t>(memory_bytes / engine.workers.count(), 1, kUsefulBytes);
    // Two thirds full on average, so that ordinary scatter does not overflow a bucket.
    const std::uint64_t bytes = records * record_bytes() + std::uint64_t{key_end - key_first} * 4;
    const std::uint64_t wanted = std::max(least_buckets, bytes * 3 / (worker_bytes * 2) + 1);
    const std::uint64_t bucket_cost =
        Partition<Record>::memory_bytes(1, engine.workers.count(), engine.block_bytes());
    const std::uint64_t affordable = std::max<std::uint64_t>(2, distribution_bytes / bucket_cost);
    const std::uint64_t buckets = std::min(wanted, affordable);
    const std::uint64_t keys = std::max<std::uint64_t>(1, key_end - key_first);
    return {key_first, key_end, static_cast<std::uint32_t>((keys + buckets - 1) / buckets)};
  }

  /// Records distributed by key.
  struct Buckets {
    KeyRanges ranges;
    std::vector<Spill<Record>> spills;
  };

  /// Distributes the records, about `records` with keys below `key_end`, that fill(push) hands to
  /// push(worker, record). `fill` may use a block of memory a worker, and up to four, besides.
  template <class Fill>
  static Buckets distribute(const Engine& engine, std::uint64_t records, std::uint64_t key_end,
                            std::string_view who, Fill fill, std::uint64_t least_buckets = 1) {
    const std::uint64_t free_bytes = engine.budget.free_bytes();
    const KeyRanges ranges = plan(engine, records, 0, static_cast<std::uint32_t>(key_end),
                                  free_bytes / 8 * 7, free_bytes / 2, least_buckets);
    const Reservation memory = engine.budget.reserve(
        Partition<Record>::memory_bytes(ranges.bucket_count(), engine.workers.count(),
                                        engine.block_bytes()) +
            (engine.workers.count() + 4) * engine.block_bytes(),
        who);
    Partition<Record> partition(engine.scratch, ranges.bucket_count());
    std::vector<typename Partition<Record>::Writer> writers;
    for (std::size_t i = 0; i < engine.workers.count(); ++i) writers.emplace_back(partition);
    fill([&](std::size_t worker, const Record& record) {
      writers[worker].push(ranges.bucket_of(record.key()), record);
    });
    for (auto& writer : writers) writer.flush();
    return {ranges, partition.finish()};
  }

  /// `largest_group`: keys with more records are handed over as a Spill even if they fit in memory,
  /// for users whose own memory grows with the group.
  KeyedGroups(const Engine& engine, OnGroup on_group, OnHotKey on_hot_key,
              std::size_t largest_group = ~std::size_t{0})
      : engine_(engine),
        on_group_(std::move(on_group)),
        on_hot_key_(std::move(on_hot_key)),
        largest_group_(largest_group),
        memory_(engine.workers.count()) {}

  /// Loaded and sorted copy of one record.
  static constexpr std::uint64_t record_bytes() { return 2 * sizeof(Record); }

  /// Groups `count` records of keys [first, last) that load(std::span<Record>) copies, in
  /// `memory_bytes` that the caller has reserved: record_bytes() each, and four a key, without
  /// which sorting is slower. Any worker. The memory is kept for the next; see release_memory().
  template <class Load>
  void group(std::size_t worker, std::size_t count, std::pair<std::uint32_t, std::uint32_t> keys,
             std::uint64_t memory_bytes, Load load) {
    Memory& memory = memory_[worker];
    memory.loaded.resize(count);
    load(memory.loaded.all());
    const std::uint64_t key_count = keys.second - keys.first;
    const bool counting = key_count <= 4 * std::uint64_t{count} + 64 &&
                          count * record_bytes() + 4 * key_count <= memory_bytes;
    counting ? counting_sort(memory, keys) : comparison_sort(memory);
    call_groups(worker, (counting ? memory.sorted : memory.loaded).all());
  }

  void release_memory() {
    for (Memory& memory : memory_) memory = {};
  }

  /// Consumes the buckets. Uses what the budget has free, and needs about three blocks of it.
  void process(Buckets all_buckets, StageLog::Stage* stage = nullptr) {
    const KeyRanges ranges = all_buckets.ranges;
    std::vector<Spill<Record>> buckets = std::move(all_buckets.spills);
    std::vector<std::size_t> small, large;
    {
      const Reservation all = reserve();
      const std::uint64_t worker_bytes = all.bytes() / engine_.workers.count();
      for (std::size_t i = 0; i < buckets.size(); ++i) {
        if (buckets[i].empty()) continue;
        (fits(buckets[i].size(), worker_bytes) ? small : large).push_back(i);
      }
      engine_.workers.for_each(small.size(), [&](std::size_t worker, std::size_t item) {
        const std::size_t bucket = small[item];
        sort_and_call(worker, std::move(buckets[bucket]), ranges.keys_of(bucket), worker_bytes);
        if (stage != nullptr && worker == 0) stage->progress(item + 1);
      });
      release_memory();
    }
    for (Spill<Record>& group : std::exchange(large_groups_, {})) hand_over(std::move(group));
    for (const std::size_t bucket : large) {
      split(std::move(buckets[bucket]), ranges.keys_of(bucket));
    }
  }

 private:
  struct Memory {
    RecordBuffer<Record> loaded, sorted;
    std::vector<std::uint32_t> ends;
  };

  /// Larger buckets fall out of the caches, and touch memory that smaller ones would use again.
  static constexpr std::uint64_t kUsefulBytes = 24 << 20;

  Reservation reserve() const {
    const std::uint64_t least = engine_.workers.count() * (engine_.block_bytes() + 4096);
    return engine_.budget.reserve_between(least, ~std::uint64_t{0} >> 1, "grouping records by key");
  }

  bool fits(std::uint64_t records, std::uint64_t worker_bytes) const {
    return records * record_bytes() + engine_.block_bytes() <= worker_bytes;
  }

  void sort_and_call(std::size_t worker, Spill<Record> bucket,
                     std::pair<std::uint32_t, std::uint32_t> keys, std::uint64_t worker_bytes) {
    group(worker, bucket.size(), keys, worker_bytes - engine_.block_bytes(),
          [&](std::span<Record> to) {
            SpillReader<Record>(bucket, SpillReader<Record>::Mode::kConsume).read(to);
            bucket.clear();
          });
  }

  static void counting_sort(Memory& memory, std::pair<std::uint32_t, std::uint32_t> keys) {
    memory.ends.assign(keys.second - keys.first, 0);
    for (const Record& record : memory.loaded) ++memory.ends[record.key() - keys.first];
    std::uint32_t end = 0;
    for (std::uint32_t& count : memory.ends) count = std::exchange(end, end + count);
    memory.sorted.resize(memory.loaded.size());
    for (const Record& record : memory.loaded) {
      memory.sorted[memory.ends[record.key() - keys.first]++] = record;
    }
  }

  static void comparison_sort(Memory& memory) {
    std::sort(memory.loaded.begin(), memory.loaded.end(),
              [](const Record& a, const Record& b) { return a.key() < b.key(); });
  }

  void call_groups(std::size_t worker, std::span<Record> records) {
    for (std::size_t begin = 0, end = 0; begin < records.size(); begin = end) {
      while (end < records.size() && records[end].key() == records[begin].key()) ++end;
      const std::span<Record> group = records.subspan(begin, end - begin);
      group.size() > largest_group_ ? set_aside(group) : on_group_(worker, group);
    }
  }

  void set_aside(std::span<const Record> group) {
    SpillWriter<Record> writer(engine_.scratch);
    writer.append(group);
    const std::lock_guard lock(large_groups_mutex_);
    large_groups_.push_back(writer.finish());
  }

  void hand_over(Spill<Record> group) {
    Record first{};
    SpillReader<Record>(group).read(first);
    on_hot_key_(first.key(), std::move(group));
  }

  /// Distributes a large bucket by narrower ranges, or hands over its only key.
  void split(Spill<Record> bucket, std::pair<std::uint32_t, std::uint32_t> keys) {
    if (keys.second - keys.first == 1) return on_hot_key_(keys.first, std::move(bucket));
    KeyRanges ranges;
    std::vector<Spill<Record>> parts;
    {
      const Reservation all = reserve();
      ranges = plan(engine_, bucket.size(), keys.first, keys.second, all.bytes(), all.bytes() / 2);
      ranges.keys_per_bucket = std::min(ranges.keys_per_bucket, (keys.second - keys.first + 1) / 2);
      Partition<Record> partition(engine_.scratch, ranges.bucket_count());
      typename Partition<Record>::Writer writer(partition);
      SpillReader<Record> reader(bucket, SpillReader<Record>::Mode::kConsume);
      for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
        for (const Record& record : block) writer.push(ranges.bucket_of(record.key()), record);
      }
      writer.flush();
      parts = partition.finish();
    }
    process({ranges, std::move(parts)});
  }

  const Engine& engine_;
  OnGroup on_group_;
  OnHotKey on_hot_key_;
  std::size_t largest_group_;
  std::vector<Memory> memory_;
  std::mutex large_groups_mutex_;
  std::vector<Spill<Record>> large_groups_;
};

}  // namespace atlasgauge
