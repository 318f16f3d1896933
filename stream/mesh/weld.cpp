#include "stream/mesh/weld.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "stream/engine/partition.hpp"
#include "stream/engine/record_buffer.hpp"
#include "stream/engine/sort_spill.hpp"

namespace atlasgauge {
namespace {

struct PlacedVertex {
  Position p;
  VertexId v;
};

/// `v` coincides with the smaller `first`.
struct Coincidence {
  VertexId v;
  VertexId first;
};

/// Mixes the bits of the three coordinates (the finalizer of MurmurHash3 between them).
std::uint64_t hash_of(const Position& p) {
  const auto mix = [](std::uint64_t h) {
    h ^= h >> 33;
    h *= 0xff51afd7ed558ccdULL;
    h ^= h >> 33;
    h *= 0xc4ceb9fe1a85ec53ULL;
    return h ^ (h >> 33);
  };
  std::uint64_t h = mix(std::bit_cast<std::uint64_t>(p.x) + 0x9E3779B97F4A7C15ULL);
  h = mix(h ^ std::bit_cast<std::uint64_t>(p.y));
  return mix(h ^ std::bit_cast<std::uint64_t>(p.z));
}

bool is_nan(const Position& p) {
  return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z);
}

bool equal(const Position& a, const Position& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Open addressing with linear probing; at most half full.
class DistinctPositions {
 public:
  static constexpr std::uint64_t kEntryBytes = 2 * sizeof(PlacedVertex);

  /// Empties the table.
  void reset(std::uint64_t capacity) {
    capacity_ = capacity;
    size_ = 0;
    slots_.resize(std::bit_ceil(2 * capacity));
    std::fill(slots_.begin(), slots_.end(), kEmpty);
  }

  /// The vertex first seen at this position: `vertex` itself, which is added while there is room,
  /// or kNone when it is new and there is none.
  VertexId first_at(const PlacedVertex& vertex) {
    std::size_t at = hash_of(vertex.p) & (slots_.size() - 1);
    while (slots_[at].v != kNone<VertexId> && !equal(slots_[at].p, vertex.p)) {
      at = (at + 1) & (slots_.size() - 1);
    }
    if (slots_[at].v == kNone<VertexId> && size_ < capacity_) {
      slots_[at] = vertex;
      ++size_;
    }
    return slots_[at].v;
  }

 private:
  static constexpr PlacedVertex kEmpty{{0, 0, 0}, kNone<VertexId>};
  std::uint64_t capacity_ = 0;
  std::uint64_t size_ = 0;
  RecordBuffer<PlacedVertex> slots_;
};

class Welding {
 public:
  explicit Welding(const Engine& engine) : engine_(engine), coincidences_(engine.scratch) {}

  Spill<Coincidence> run(MeshStore& mesh) {
    std::vector<Spill<PlacedVertex>> buckets = distribute(mesh);
    std::vector<std::size_t> large;
    {
      const Reservation all = reserve();
      const std::uint64_t capacity = table_capacity(all.bytes() / engine_.workers.count());
      for (std::size_t i = 0; i < buckets.size(); ++i) {
        if (buckets[i].size() > capacity) large.push_back(i);
      }
      std::vector<DistinctPositions> tables(engine_.workers.count());
      engine_.workers.for_each(buckets.size(), [&](std::size_t worker, std::size_t i) {
        if (buckets[i].size() > capacity) return;
        tables[worker].reset(buckets[i].size());
        match(std::move(buckets[i]), tables[worker], [](const PlacedVertex&) {});
      });
    }
    for (const std::size_t i : large) match_large(std::move(buckets[i]), 1);
    return coincidences_.finish();
  }

 private:
  /// Larger tables fall out of the caches.
  static constexpr std::uint64_t kUsefulBytes = 24 << 20;

  /// Bits of the hash that choose the bucket, in rounds of eight from the top; the table uses the
  /// low ones.
  static std::size_t bucket_of(std::uint64_t hash, unsigned round, std::size_t buckets) {
    return static_cast<std::size_t>(((hash >> (48 - 8 * (round % 5))) & 0xFFFF) % buckets);
  }

  Reservation reserve() const {
    return engine_.budget.reserve_between(8 * engine_.block_bytes(), ~std::uint64_t{0} >> 1,
                                          "welding vertices");
  }

  std::uint64_t table_capacity(std::uint64_t memory_bytes) const {
    const std::uint64_t blocks = 2 * engine_.block_bytes();
    // A power of two of slots: twice the capacity may round up to nearly four times.
    return std::max<std::uint64_t>(
        64, (memory_bytes - std::min(memory_bytes, blocks)) / (2 * DistinctPositions::kEntryBytes));
  }

  std::vector<Spill<PlacedVertex>> distribute(MeshStore& mesh) {
    const Reservation all = reserve();
    const std::uint64_t workers = engine_.workers.count();
    const std::uint64_t capacity =
        table_capacity(std::min<std::uint64_t>(all.bytes() / workers, kUsefulBytes));
    const std::uint64_t wanted = mesh.positions.size() * 3 / (2 * capacity) + 1;
    const std::uint64_t cost = Partition<PlacedVertex>::memory_bytes(1, 1, engine_.block_bytes());
    const std::uint64_t affordable = std::max<std::uint64_t>(2, all.bytes() / 2 / cost);
    Partition<PlacedVertex> partition(engine_.scratch, std::min(wanted, affordable));
    Partition<PlacedVertex>::Writer writer(partition);
    SpillReader<Position> reader(mesh.positions);
    std::uint32_t v = 0;
    for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
      for (const Position& p : block) {
        const VertexId id{v++};
        if (is_nan(p)) continue;
        writer.push(bucket_of(hash_of(p), 0, partition.bucket_count()), {p, id});
      }
    }
    writer.flush();
    return partition.finish();
  }

  /// Streams a bucket through an empty table. What is new when the table is full is handed to
  /// `overflow`. Buckets keep the order of the vertices, so the first at a
  /// position is the smallest.
  template <class Overflow>
  void match(Spill<PlacedVertex> bucket, DistinctPositions& distinct, Overflow overflow) {
    SharedSpill<Coincidence>::Writer writer(coincidences_);
    SpillReader<PlacedVertex> reader(bucket, SpillReader<PlacedVertex>::Mode::kConsume);
    for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
      for (const PlacedVertex& vertex : block) {
        const VertexId first = distinct.first_at(vertex);
        if (first == kNone<VertexId>) {
          overflow(vertex);
        } else if (first != vertex.v) {
          writer.push({vertex.v, first});
        }
      }
    }
    writer.flush();
  }

  /// A bucket with more vertices than the table holds, though perhaps few distinct positions. The
  /// overflow goes to buckets by other bits of the hash; every round takes a table full of it away.
  void match_large(Spill<PlacedVertex> bucket, unsigned round) {
    std::vector<Spill<PlacedVertex>> rest;
    {
      constexpr std::size_t kBuckets = 8;
      const Reservation all = reserve();
      const std::uint64_t partition_bytes =
          Partition<PlacedVertex>::memory_bytes(kBuckets, 1, engine_.block_bytes());
      const std::uint64_t capacity =
          table_capacity(all.bytes() - std::min(all.bytes(), partition_bytes));
      Partition<PlacedVertex> partition(engine_.scratch, kBuckets);
      Partition<PlacedVertex>::Writer writer(partition);
      DistinctPositions distinct;
      distinct.reset(capacity);
      match(std::move(bucket), distinct, [&](const PlacedVertex& vertex) {
        writer.push(bucket_of(hash_of(vertex.p), round, kBuckets), vertex);
      });
      writer.flush();
      rest = partition.finish();
    }
    for (Spill<PlacedVertex>& part : rest) {
      if (!part.empty()) match_large(std::move(part), round + 1);
    }
  }

  const Engine& engine_;
  SharedSpill<Coincidence> coincidences_;
};

/// The welded vertex of every vertex, from the exceptions.
Spill<VertexId> welded_table(const Engine& engine, Spill<Coincidence> coincidences,
                             std::uint64_t vertices) {
  Spill<Coincidence> sorted =
      sort_spill(engine, std::move(coincidences),
                 [](const Coincidence& a, const Coincidence& b) { return raw(a.v) < raw(b.v); });
  SpillReader<Coincidence> reader(sorted, SpillReader<Coincidence>::Mode::kConsume);
  Coincidence next{kNone<VertexId>, kNone<VertexId>};
  bool more = reader.read(next);
  SpillWriter<VertexId> table(engine.scratch);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const bool coincides = more && raw(next.v) == v;
    table.push(coincides ? next.first : VertexId{v});
    if (coincides) more = reader.read(next);
  }
  return table.finish();
}

}  // namespace

Weld weld_vertices(const Engine& engine, MeshStore& mesh) {
  StageLog::Stage stage(engine.log, "weld");
  Spill<Coincidence> coincidences = Welding(engine).run(mesh);
  Weld weld;
  weld.duplicates = coincidences.size();
  if (weld.found_any()) {
    weld.welded = welded_table(engine, std::move(coincidences), mesh.positions.size());
  }
  return weld;
}

LastUses last_faces_of_welded(const Engine& engine, const LastUses& last_faces, const Weld& weld) {
  if (!last_faces.knows_any()) return {};
  LastUses of_welded(engine.budget);
  SpillReader<VertexId> reader(weld.welded);
  std::uint32_t v = 0;
  for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
    for (const VertexId welded : block) {
      of_welded.note(raw(welded), last_faces.items_until_unused(v++));
    }
  }
  return of_welded;
}

}  // namespace atlasgauge
