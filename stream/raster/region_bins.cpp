#include "stream/raster/region_bins.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>
#include <utility>

#include "stream/engine/partition.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {
namespace {

using Groups = KeyedGroups<RegionTriangle>;
using RegionPartition = Partition<RegionTriangle>;

/// Of records more than there are faces: for those near the border of a region.
constexpr std::uint64_t kCopiesShare = 8;

KeyRanges plan_buckets(const Engine& engine, std::uint64_t faces, const AtlasRegions& regions,
                       std::uint64_t drawing_bytes) {
  const std::uint64_t free_bytes = engine.budget.free_bytes();
  const std::uint64_t records = (faces + faces / kCopiesShare) * regions.most_tiers();
  return Groups::plan(engine, records, 0, regions.count(), (free_bytes - drawing_bytes) / 8 * 7,
                      free_bytes / 2, Groups::even_buckets(engine));
}

/// Distributes blocks of faces, all workers at once.
class Distribution {
 public:
  Distribution(const Engine& engine, Spill<Label>& charts, Spill<AtlasFace>& faces, bool keep_faces,
               const AtlasRegions& regions, const KeyRanges& ranges)
      : engine_(engine),
        faces_(faces),
        keep_faces_(keep_faces),
        regions_(regions),
        ranges_(ranges),
        charts_(charts),
        partition_(engine.scratch, ranges.bucket_count()),
        triangles_(regions.slots()) {
    for (std::size_t i = 0; i < engine.workers.count(); ++i) workers_.emplace_back(partition_);
  }

  static std::uint64_t memory_bytes(const Engine& engine, const KeyRanges& ranges) {
    const std::uint64_t block = engine.block_bytes();
    const std::uint64_t charts = block / sizeof(AtlasFace) * sizeof(Label);
    return RegionPartition::memory_bytes(ranges.bucket_count(), engine.workers.count(), block) +
           engine.workers.count() * (block + charts) + block;
  }

  RegionBins run(StageLog::Stage& stage) {
    engine_.workers.run({.produce = [&](std::size_t worker) { return next(worker, stage); },
                         .transform = [&](std::size_t worker) { distribute(workers_[worker]); },
                         .commit = {}});
    for (Worker& worker : workers_) worker.writer.flush();
    return {{ranges_, partition_.finish()}, {triangles_.begin(), triangles_.end()}};
  }

 private:
  struct Worker {
    explicit Worker(RegionPartition& partition) : writer(partition) {}
    RegionPartition::Writer writer;
    std::size_t block = 0;
    BlockBuffer buffer;
    std::vector<Label> charts;
  };

  /// Triangles of one slot in a row, which are counted at once.
  class Run {
   public:
    explicit Run(std::vector<std::atomic<std::uint32_t>>& triangles) : triangles_(triangles) {}
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    ~Run() { end(); }
    void add(SlotId slot) {
      if (slot != slot_) end();
      slot_ = slot;
      ++length_;
    }

   private:
    void end() {
      if (length_ > 0) triangles_[raw(slot_)].fetch_add(length_, std::memory_order_relaxed);
      length_ = 0;
    }

    std::vector<std::atomic<std::uint32_t>>& triangles_;
    SlotId slot_ = kNone<SlotId>;
    std::uint32_t length_ = 0;
  };

  bool next(std::size_t worker, StageLog::Stage& stage) {
    if (next_block_ == faces_.block_count()) return false;
    Worker& own = workers_[worker];
    own.block = next_block_++;
    own.charts.resize(faces_.records_in_block(own.block));
    faces_.read_ahead(next_block_);
    charts_.read(own.charts);
    stage.progress(own.block * faces_.records_per_block());
    return true;
  }

  void distribute(Worker& worker) {
    const std::span<const AtlasFace> faces = faces_.load(worker.block, worker.buffer);
    Run run(triangles_);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (faces[i].is_drawn()) distribute(faces[i], worker.charts[i].first(), worker.writer, run);
    }
    if (!keep_faces_) faces_.free_block(worker.block);
  }

  void distribute(const AtlasFace& face, std::uint32_t chart, RegionPartition::Writer& writer,
                  Run& run) {
    bool is_first = true;
    regions_.visit_touched(face.slot(), face.uv(), [&](std::uint32_t region) {
      writer.push(ranges_.bucket_of(region), {region, chart, is_first, face.uv()});
      is_first = false;
    });
    if (!is_first) run.add(face.slot());
  }

  const Engine& engine_;
  Spill<AtlasFace>& faces_;
  const bool keep_faces_;
  const AtlasRegions& regions_;
  const KeyRanges ranges_;
  SpillReader<Label> charts_;
  std::size_t next_block_ = 0;
  RegionPartition partition_;
  std::vector<Worker> workers_;
  std::vector<std::atomic<std::uint32_t>> triangles_;  ///< by slot
};

}  // namespace

RegionBins distribute_to_regions(const Engine& engine, Spill<Label>& charts,
                                 Spill<AtlasFace>& faces, bool keep_faces,
                                 const AtlasRegions& regions, std::uint64_t drawing_bytes,
                                 StageLog::Stage& stage) {
  const KeyRanges ranges = plan_buckets(engine, faces.size(), regions, drawing_bytes);
  const Reservation memory = engine.budget.reserve(Distribution::memory_bytes(engine, ranges),
                                                   "distributing triangles to textures");
  return Distribution(engine, charts, faces, keep_faces, regions, ranges).run(stage);
}

}  // namespace atlasgauge
