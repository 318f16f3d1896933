#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "stream/engine/chunk_pool.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/engine/last_uses.hpp"

namespace atlasgauge {

/// Groups records by key, out of core, and does so early: a range of keys is grouped as soon as no
/// record of it can come any more. Records come from items (faces) in the order of their numbers,
/// and LastUses says with which item each range of keys ends. Where items that name a key are near
/// each other, few ranges are open at a time, and records never leave memory. Where they are not,
/// it works as KeyedGroups does.
///
/// How it goes on:
///   1. The keys are cut into cells, each small enough to be sorted within the caches, and cells
///      are joined to buckets, few enough that each may have a block of memory to spill through.
///   2. add(), from all workers at once, puts records into chunks of their cells. Nothing stays
///      with a worker: when add() returns, its records are where every worker finds them.
///   3. pass(n), from one worker at a time, says that the records of the first n items have been
///      added. The cells that this completes are queued.
///   4. group_passed(), from all workers at once, takes cells from the queue, groups them and frees
///      their chunks.
///   5. When chunks run short, the bucket that holds most of them is spilled; cells that lose
///      records by that are grouped in the end.
///   6. settle(), after the last item, groups the cells that are still in memory, spills the rest
///      and frees the memory; process() groups the rest as KeyedGroups does.
/// A cell is thus open (all its records are in chunks), spilled (some are in the spill of its
/// bucket, and all will be), or grouped (and no record may come).
///
/// `Record` has key(). Groups come in no particular order, their records neither.
template <class Record>
class EarlyGroups {
 public:
  using OnGroup = typename KeyedGroups<Record>::OnGroup;
  using OnHotKey = typename KeyedGroups<Record>::OnHotKey;

  struct Plan {
    std::uint64_t records;       ///< about
    std::uint32_t key_end;       ///< keys are below
    std::uint64_t memory_bytes;  ///< to be used at most, until settle()
    std::string_view who;        ///< asks for it
  };

  /// on_group() and on_hot_key() as of KeyedGroups; groups with more records than `largest_group`
  /// go to the latter. Copies what it needs of `last_uses`, which may know nothing.
  EarlyGroups(const Engine& engine, const Plan& plan, const LastUses& last_uses, OnGroup on_group,
              OnHotKey on_hot_key, std::size_t largest_group = ~std::size_t{0})
      : engine_(engine),
        layout_(engine, plan, last_uses),
        memory_(engine.budget.reserve(layout_.memory_bytes(engine), plan.who)),
        groups_(engine, std::move(on_group), std::move(on_hot_key), largest_group),
        pool_(std::in_place, layout_.pool_bytes),
        cells_(layout_.cells),
        batches_(engine.workers.count()) {
    for (std::size_t i = 0; i < layout_.buckets; ++i) {
      buckets_.push_back(std::make_unique<Bucket>(engine.scratch));
    }
    for (Batch& batch : batches_) batch.ends.resize(layout_.buckets + 1);
    if (layout_.ends_early) order_cells(last_uses);
  }

  /// One thread a worker.
  void add(std::size_t worker, std::span<const Record> records) {
    make_room();
    Batch& batch = batches_[worker];
    sort_by_bucket(records, batch);
    for (std::size_t i = 0; i < layout_.buckets; ++i) {
      if (batch.ends[i] == batch.ends[i + 1]) continue;
      Bucket& bucket = *buckets_[i];
      const std::lock_guard lock(bucket.mutex);
      for (std::uint32_t at = batch.ends[i]; at < batch.ends[i + 1]; ++at) {
        const std::uint32_t record = batch.order[at];
        put(bucket, cells_[batch.cells[record]], records[record]);
      }
    }
  }

  /// By one thread at a time, after the records of the first `items` items have been added.
  void pass(std::uint64_t items) {
    if (!passes_next(items)) return;
    const std::lock_guard lock(passed_mutex_);
    while (passes_next(items)) passed_.push_back(ends_[next_end_++].cell);
  }

  /// One thread a worker.
  void group_passed(std::size_t worker) {
    for (std::optional<std::uint32_t> cell; (cell = take_passed());) group_cell(worker, *cell);
  }

  /// After the last add(), by the calling thread of the workers.
  void settle() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].records > 0) open.push_back(i);
    }
    engine_.workers.for_each(
        open.size(), [&](std::size_t worker, std::size_t item) { group_cell(worker, open[item]); });
    rest_.ranges = {0, layout_.key_end, layout_.cells_per_bucket * layout_.keys_per_cell};
    for (const auto& bucket : buckets_) rest_.spills.push_back(bucket->writer.finish());
    buckets_.clear();
    pool_.reset();
    groups_.release_memory();
    memory_.release();
  }

  /// After settle(). Uses what the budget has free.
  void process(StageLog::Stage* stage = nullptr) { groups_.process(std::move(rest_), stage); }

 private:
  using ChunkId = typename ChunkPool<Record>::ChunkId;
  static constexpr ChunkId kNoChunk = ChunkPool<Record>::kNoChunk;
  static constexpr std::uint32_t kChunkRecords = ChunkPool<Record>::kRecords;

  enum class State : std::uint8_t { kOpen, kSpilled, kGrouped };

  /// The first chunk holds the last records; the others are full.
  struct Cell {
    ChunkId first = kNoChunk;
    std::uint32_t records = 0;  // in chunks
    State state = State::kOpen;
  };

  struct Bucket {
    explicit Bucket(Scratch& scratch) : writer(scratch) {}
    std::mutex mutex;  // of the writer, and of the bucket's cells
    SpillWriter<Record> writer;
    std::atomic<std::uint32_t> chunks = 0;
  };

  /// The records of one add() by bucket.
  struct Batch {
    std::vector<std::uint32_t> cells, ends, order;
  };

  struct CellEnd {
    std::uint32_t items, cell;
  };

  /// How the memory is shared out.
  struct Layout {
    /// Sorting stays within the caches, and few records wait in the cells that are open.
    static constexpr double kCellBytes = 64 << 10;
    /// A cell is grouped early if it has up to this many times the average of records.
    static constexpr std::uint64_t kScatter = 4;

    Layout(const Engine& engine, const Plan& plan, const LastUses& last_uses)
        : key_end(std::max(1U, plan.key_end)) {
      const std::uint64_t records_bytes = plan.records * sizeof(Record);
      // Hardly a range would end before it is spilled, and many cells cost more than few.
      ends_early = last_uses.knows_any() &&
                   (records_bytes <= plan.memory_bytes / 2 || !last_uses.are_late());
      const KeyRanges spills = KeyedGroups<Record>::plan(
          engine, plan.records, 0, key_end, engine.budget.free_bytes() / 8 * 7,
          ends_early ? plan.memory_bytes / 2 : plan.memory_bytes / 4 * 3);
      const double key_bytes = static_cast<double>(records_bytes) / key_end;
      most_group_bytes = plan.memory_bytes / 8 / engine.workers.count();
      keys_per_cell =
          ends_early ? keys_of_early_cell(plan, last_uses, key_bytes) : spills.keys_per_bucket;
      cells = (key_end - 1) / keys_per_cell + 1;
      cells_per_bucket = (spills.keys_per_bucket - 1) / keys_per_cell + 1;
      buckets = (cells - 1) / cells_per_bucket + 1;
      share_memory(plan, static_cast<std::uint64_t>(keys_per_cell * key_bytes),
                   memory_bytes(engine), engine.workers.count());
    }

    /// A number of whole ranges of `last_uses`; both are powers of two.
    std::uint32_t keys_of_early_cell(const Plan& plan, const LastUses& last_uses,
                                     double key_bytes) const {
      const double wanted_bytes =
          std::min(kCellBytes, static_cast<double>(most_group_bytes) / (2 * kScatter + 2));
      const std::uint64_t most = std::max<std::uint64_t>(1, plan.memory_bytes / 16 / kCellCost);
      std::uint32_t keys = last_uses.keys_per_range();
      while (keys < key_end && (keys * key_bytes < wanted_bytes || (key_end - 1) / keys >= most)) {
        keys *= 2;
      }
      return keys;
    }

    /// What buckets and cells leave, to workers and chunks.
    void share_memory(const Plan& plan, std::uint64_t average_bytes, std::uint64_t used_bytes,
                      std::uint64_t workers) {
      const std::uint64_t counts_bytes = std::uint64_t{4} * keys_per_cell;
      const std::uint64_t rest_bytes = plan.memory_bytes - std::min(plan.memory_bytes, used_bytes);
      if (ends_early) {
        group_bytes =
            std::min(rest_bytes / 2 / workers, 2 * kScatter * average_bytes + counts_bytes + 4096);
      }
      capacity =
          (group_bytes - std::min(group_bytes, counts_bytes)) / KeyedGroups<Record>::record_bytes();
      const std::uint64_t useful_bytes = plan.records * (sizeof(Record) + sizeof(ChunkId)) +
                                         (cells + 1) * ChunkPool<Record>::kChunkBytes;
      pool_bytes = std::min(useful_bytes, rest_bytes - workers * group_bytes);
    }

    std::uint64_t memory_bytes(const Engine& engine) const {
      return pool_bytes + buckets * engine.block_bytes() + cells * kCellCost +
             engine.workers.count() * group_bytes;
    }

    static constexpr std::uint64_t kCellCost = sizeof(Cell) + sizeof(CellEnd) + 8;  // and in queues

    std::uint32_t key_end;
    bool ends_early = false;
    std::uint32_t keys_per_cell = 1;
    std::uint32_t cells_per_bucket = 1;
    std::size_t cells = 1;
    std::size_t buckets = 1;
    std::uint64_t most_group_bytes = 0;
    std::uint64_t group_bytes = 0;  // of a worker
    std::uint64_t capacity = 0;     // records that can be grouped in them
    std::uint64_t pool_bytes = 0;
  };

  /// A cell is a number of whole ranges of `last_uses`.
  void order_cells(const LastUses& last_uses) {
    std::vector<std::uint32_t> items(cells_.size());
    for (std::uint64_t key = 0; key < layout_.key_end; key += last_uses.keys_per_range()) {
      std::uint32_t& last = items[key / layout_.keys_per_cell];
      last = std::max(last, last_uses.items_until_unused(static_cast<std::uint32_t>(key)));
    }
    for (std::uint32_t cell = 0; cell < items.size(); ++cell) {
      if (items[cell] > 0) ends_.push_back({items[cell], cell});
    }
    std::sort(ends_.begin(), ends_.end(),
              [](const CellEnd& a, const CellEnd& b) { return a.items < b.items; });
  }

  bool passes_next(std::uint64_t items) const {
    return next_end_ < ends_.size() && ends_[next_end_].items <= items;
  }

  std::optional<std::uint32_t> take_passed() {
    const std::lock_guard lock(passed_mutex_);
    if (passed_.empty()) return std::nullopt;
    const std::uint32_t cell = passed_.back();
    passed_.pop_back();
    return cell;
  }

  std::uint32_t bucket_of(std::uint32_t cell) const { return cell / layout_.cells_per_bucket; }
  std::pair<std::uint32_t, std::uint32_t> keys_of(std::uint32_t cell) const {
    const std::uint64_t first = std::uint64_t{cell} * layout_.keys_per_cell;
    return {static_cast<std::uint32_t>(first),
            static_cast<std::uint32_t>(
                std::min<std::uint64_t>(layout_.key_end, first + layout_.keys_per_cell))};
  }

  /// A counting sort; afterwards the records of bucket i are at [ends[i], ends[i + 1]).
  void sort_by_bucket(std::span<const Record> records, Batch& batch) const {
    std::fill(batch.ends.begin(), batch.ends.end(), 0U);
    batch.cells.resize(records.size());
    batch.order.resize(records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
      batch.cells[i] = records[i].key() / layout_.keys_per_cell;
      ++batch.ends[bucket_of(batch.cells[i])];
    }
    std::inclusive_scan(batch.ends.begin(), batch.ends.end(), batch.ends.begin());
    for (std::size_t i = records.size(); i-- > 0;) {
      batch.order[--batch.ends[bucket_of(batch.cells[i])]] = static_cast<std::uint32_t>(i);
    }
  }

  /// Under the lock of the bucket.
  void put(Bucket& bucket, Cell& cell, const Record& record) {
    if (cell.state == State::kGrouped) {
      throw Error(ErrorKind::kInternal, "a record came after the last of its key");
    }
    const std::uint32_t at = cell.records % kChunkRecords;
    if (at == 0 && !grow(bucket, cell)) {
      cell.state = State::kSpilled;
      bucket.writer.push(record);
      return;
    }
    pool_->records(cell.first)[at] = record;
    ++cell.records;
  }

  bool grow(Bucket& bucket, Cell& cell) {
    const ChunkId chunk = pool_->take(cell.first);
    if (chunk == kNoChunk) return false;
    cell.first = chunk;
    bucket.chunks.fetch_add(1, std::memory_order_relaxed);
    return true;
  }

  /// So that few records find no chunk; those go to the spill of their own bucket.
  void make_room() {
    const ChunkId low_water = std::min<ChunkId>(256, pool_->chunks() / 8);
    while (pool_->free_chunks() < low_water && spill_largest_bucket()) continue;
  }

  bool spill_largest_bucket() {
    const auto largest =
        std::max_element(buckets_.begin(), buckets_.end(), [](const auto& a, const auto& b) {
          return a->chunks.load(std::memory_order_relaxed) <
                 b->chunks.load(std::memory_order_relaxed);
        });
    Bucket& bucket = **largest;
    const std::lock_guard lock(bucket.mutex);
    if (bucket.chunks.load(std::memory_order_relaxed) == 0) return false;
    const auto first =
        static_cast<std::size_t>(largest - buckets_.begin()) * layout_.cells_per_bucket;
    const std::size_t end = std::min(cells_.size(), first + layout_.cells_per_bucket);
    for (std::size_t i = first; i < end; ++i) spill(bucket, cells_[i]);
    return true;
  }

  /// Under the lock of the bucket.
  void spill(Bucket& bucket, Cell& cell) {
    if (cell.records == 0) return;
    cell.state = State::kSpilled;
    const Cell list = detach(bucket, cell);
    for_each_chunk(list, [&](std::span<const Record> records) { bucket.writer.append(records); });
    pool_->give_back(list.first);
  }

  static Cell detach(Bucket& bucket, Cell& cell) {
    const std::uint32_t chunks = (cell.records - 1) / kChunkRecords + 1;
    bucket.chunks.fetch_sub(chunks, std::memory_order_relaxed);
    return std::exchange(cell, Cell{kNoChunk, 0, cell.state});
  }

  template <class Use>
  void for_each_chunk(const Cell& list, Use use) {
    std::uint32_t records = (list.records - 1) % kChunkRecords + 1;
    for (ChunkId chunk = list.first; chunk != kNoChunk; chunk = pool_->next(chunk)) {
      use(std::span<const Record>(pool_->records(chunk).first(records)));
      records = kChunkRecords;
    }
  }

  /// Of which all records have come.
  void group_cell(std::size_t worker, std::uint32_t index) {
    Cell list;
    {
      Bucket& bucket = *buckets_[bucket_of(index)];
      const std::lock_guard lock(bucket.mutex);
      Cell& cell = cells_[index];
      if (cell.state == State::kSpilled || cell.records > layout_.capacity) {
        return spill(bucket, cell);
      }
      cell.state = State::kGrouped;
      if (cell.records == 0) return;
      list = detach(bucket, cell);
    }
    groups_.group(worker, list.records, keys_of(index), layout_.group_bytes,
                  [&](std::span<Record> to) {
                    for_each_chunk(list, [&](std::span<const Record> records) {
                      std::copy(records.begin(), records.end(), to.begin());
                      to = to.subspan(records.size());
                    });
                    pool_->give_back(list.first);
                  });
  }

  const Engine& engine_;
  const Layout layout_;
  Reservation memory_;
  KeyedGroups<Record> groups_;
  std::optional<ChunkPool<Record>> pool_;
  std::vector<std::unique_ptr<Bucket>> buckets_;
  std::vector<Cell> cells_;
  std::vector<Batch> batches_;

  std::vector<CellEnd> ends_;  // in the order of items
  std::size_t next_end_ = 0;   // of the one that calls pass()
  std::mutex passed_mutex_;
  std::vector<std::uint32_t> passed_;

  typename KeyedGroups<Record>::Buckets rest_;
};

}  // namespace atlasgauge
