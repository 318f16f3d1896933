// What the edge table costs a half-edge, all in: from the faces to the groups at three levels.

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/stages/bench_engine.hpp"
#include "bench/stages/grid.hpp"
#include "bench/stages/group_counts.hpp"
#include "bench/stages/job.hpp"
#include "stream/mesh/edges.hpp"

namespace {

using namespace atlasgauge;

SlotFrames one_unit_slot() {
  SlotFrame frame;
  frame.has_size = frame.readable = true;
  frame.width = frame.height = 1;
  return SlotFrames({frame});
}

/// Triangles a batch at a time, in some order.
class TriangleSource {
 public:
  TriangleSource(const Grid& grid, Order order) : grid_(grid), ordering_(order, grid.faces()) {}

  const Grid& grid() const { return grid_; }
  std::uint32_t batches() const { return (grid_.faces() + kBatch - 1) / kBatch; }
  void fill(std::uint32_t batch, std::vector<Triangle>& some) const {
    some.clear();
    const std::uint32_t first = batch * kBatch;
    for (std::uint32_t i = first; i < std::min(grid_.faces(), first + kBatch); ++i) {
      some.push_back(grid_.triangle(ordering_(i)));
    }
  }

 private:
  static constexpr std::uint32_t kBatch = 1024;

  Grid grid_;
  Ordering ordering_;
};

struct Plan {
  std::string name() const {
    return std::string(name_of(order)) + (welded ? "/welded/" : "/") + name_of(room) +
           "/threads:" + std::to_string(threads);
  }
  Order order;
  bool welded;
  Room room;
  std::size_t threads;
};

class EdgesJob : public Job {
 public:
  EdgesJob(const Grid& grid, const Plan& plan)
      : grid_(grid), plan_(plan), source_(grid, plan.order), triangles_(plan.threads) {}

  void prepare() override {
    results_ = {};
    last_faces_.reset();
    engine_ =
        std::make_unique<BenchEngine>(plan_.room, 3 * kRecordBytes * grid_.faces(), plan_.threads);
    sinks_ = std::make_unique<CountingSinks>(plan_.threads);
    note_last_faces();
  }

  void run() override {
    const Engine& engine = engine_->engine();
    const EdgeTable::Plan plan{.welded = plan_.welded,
                               .faces = grid_.faces(),
                               .vertices = grid_.vertices(),
                               .memory_bytes = engine.budget.free_bytes() / 2,
                               .keep_borders = false};
    const auto table = EdgeTable::make(engine, plan, *last_faces_, frames_, *sinks_);
    std::vector<std::uint32_t> batch_of(plan_.threads);
    std::uint32_t next = 0;
    std::uint64_t faces = 0;
    Workers::Pipeline pipeline;
    pipeline.produce = [&](std::size_t worker) {
      batch_of[worker] = next;
      return next++ < source_.batches();
    };
    pipeline.transform = [&](std::size_t worker) {
      source_.fill(batch_of[worker], triangles_[worker]);
      table->add(worker, triangles_[worker]);
    };
    pipeline.commit = [&](std::size_t worker) { table->pass(faces += triangles_[worker].size()); };
    engine.workers.run(pipeline);
    table->settle();
    results_ = table->finish();
  }

  void check() override {
    const GroupCounts counts = sinks_->total();
    const std::uint64_t inner = grid_.edges() - grid_.boundary_edges();
    expect(counts.raw_edges == grid_.edges(), "edges are missing");
    expect(counts.boundary_edges == grid_.boundary_edges(), "the boundary is another");
    expect(counts.uv_edges == grid_.edges() + grid_.seam_edges(), "uv edges are missing");
    expect(results_.seams.size() == grid_.seam_edges(), "seams are missing");
    expect(results_.raw_links.size() == inner, "raw links are missing");
    expect(results_.uv_links.size() == inner - grid_.seam_edges(), "uv links are missing");
    expect(results_.boundary_links.size() == grid_.boundary_edges(), "boundary links are missing");
    expect(engine_->kept_to_its_room(), "scratch is not where it should be");
  }

 private:
  /// As the reader of a model does.
  void note_last_faces() {
    last_faces_ = std::make_unique<LastUses>(engine_->engine().budget);
    std::uint32_t faces = 0;
    for (std::uint32_t batch = 0; batch < source_.batches(); ++batch) {
      source_.fill(batch, triangles_[0]);
      for (const Triangle& triangle : triangles_[0]) {
        ++faces;
        for (const VertexId v : triangle.w) last_faces_->note(raw(v), faces);
      }
    }
  }

  /// About what a half-edge takes, for the budget.
  static constexpr std::uint64_t kRecordBytes = 40;

  Grid grid_;
  Plan plan_;
  TriangleSource source_;
  SlotFrames frames_ = one_unit_slot();
  std::vector<std::vector<Triangle>> triangles_;
  std::unique_ptr<BenchEngine> engine_;
  std::unique_ptr<CountingSinks> sinks_;
  std::unique_ptr<LastUses> last_faces_;  ///< gives its memory back before the engine goes
  EdgeResults results_;
};

/// Only the making of the triangles, which is in the figures of the others.
class TrianglesJob : public Job {
 public:
  TrianglesJob(const Grid& grid, Order order) : source_(grid, order) {}

  void prepare() override { area_ = 0; }
  void run() override {
    for (std::uint32_t batch = 0; batch < source_.batches(); ++batch) {
      source_.fill(batch, some_);
      for (const Triangle& triangle : some_) area_ += triangle.area_3d;
    }
  }
  void check() override { expect(area_ == 0.5 * source_.grid().faces(), "faces are missing"); }

 private:
  TriangleSource source_;
  std::vector<Triangle> some_;
  double area_ = 0;
};

std::vector<NamedJob> jobs(std::uint64_t faces) {
  const Grid grid(faces);
  std::vector<NamedJob> all;
  const auto add = [&](const std::string& name, auto make) {
    all.push_back({name, make, "half_edge", 3 * std::uint64_t{grid.faces()}});
  };
  for (const Order order : {Order::kMesh, Order::kRandom}) {
    add(std::string("triangles/") + name_of(order),
        [=] { return std::make_unique<TrianglesJob>(grid, order); });
  }
  for (const Order order : {Order::kMesh, Order::kRandom}) {
    for (const bool welded : {false, true}) {
      for (const Room room : {Room::kInMemory, Room::kBeyondMemory}) {
        for (const std::size_t threads : kThreads) {
          const Plan plan{order, welded, room, threads};
          add("edges/" + plan.name(), [=] { return std::make_unique<EdgesJob>(grid, plan); });
        }
      }
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  return run_subject(argc, argv, {"FACES", 2'000'000, jobs});
}
