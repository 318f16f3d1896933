// What looking records up by index costs: one distribution there and one back (gather), a cache of
// pages, and the join of faces with what their corners name, which chooses among them.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/stages/bench_engine.hpp"
#include "bench/stages/grid.hpp"
#include "bench/stages/job.hpp"
#include "stream/engine/gather.hpp"
#include "stream/engine/page_cache.hpp"
#include "stream/mesh/face_stream.hpp"

namespace {

using namespace atlasgauge;

Position value_of(std::uint32_t index) {
  return {static_cast<double>(index), 0.5, -static_cast<double>(index)};
}

bool is_value_of(const Position& p, std::uint32_t index) {
  return p.x == static_cast<double>(index) && p.y == 0.5 && p.z == -p.x;
}

Spill<Position> table_of(Scratch& scratch, std::uint32_t records) {
  SpillWriter<Position> writer(scratch);
  for (std::uint32_t i = 0; i < records; ++i) writer.push(value_of(i));
  return writer.finish();
}

/// A table as long as the list of its indices.
class GatherJob : public Job {
 public:
  GatherJob(std::uint32_t records, Order order, Room room)
      : records_(records), ordering_(order, records), room_(room) {}

  void prepare() override {
    clear();
    engine_ = std::make_unique<BenchEngine>(room_, records_ * sizeof(Position), 1);
    Scratch& scratch = engine_->engine().scratch;
    table_ = table_of(scratch, records_);
    SpillWriter<std::uint32_t> indices(scratch);
    for (std::uint32_t i = 0; i < records_; ++i) indices.push(ordering_(i));
    indices_ = indices.finish();
  }
  void run() override {
    found_ = gather(engine_->engine(), std::move(indices_), table_, Position{});
  }
  void check() override {
    expect(found_.size() == records_, "records are missing");
    SpillReader<Position> reader(found_);
    Position p{};
    for (std::uint32_t i = 0; reader.read(p); ++i) {
      expect(is_value_of(p, ordering_(i)), "a record is another's");
    }
    expect(engine_->kept_to_its_room(), "scratch is not where it should be");
  }

 private:
  void clear() {
    table_ = {};
    indices_ = {};
    found_ = {};
  }

  std::uint32_t records_;
  Ordering ordering_;
  Room room_;
  std::unique_ptr<BenchEngine> engine_;
  Spill<Position> table_, found_;
  Spill<std::uint32_t> indices_;
};

/// A table beyond memory, of which a quarter is cached. In random order most lookups read a page.
class PageCacheJob : public Job {
 public:
  PageCacheJob(std::uint32_t records, Order order, std::uint32_t lookups)
      : records_(records), lookups_(lookups), ordering_(order, records) {}

  void prepare() override {
    table_ = {};
    engine_ = std::make_unique<BenchEngine>(Room::kBeyondMemory, records_ * sizeof(Position), 1);
    table_ = table_of(engine_->engine().scratch, records_);
    sum_ = 0;
  }
  void run() override {
    PageCache<Position> cache(table_, engine_->engine().budget.free_bytes());
    for (std::uint32_t i = 0; i < lookups_; ++i) sum_ += cache.at(ordering_(i)).x;
  }
  void check() override {
    double expected = 0;
    for (std::uint32_t i = 0; i < lookups_; ++i) expected += static_cast<double>(ordering_(i));
    expect(sum_ == expected, "records are others'");
  }

 private:
  std::uint32_t records_, lookups_;
  Ordering ordering_;
  std::unique_ptr<BenchEngine> engine_;
  Spill<Position> table_;
  double sum_ = 0;
};

class JoinJob : public Job {
 public:
  JoinJob(const Grid& grid, Order order, Room room, std::size_t threads)
      : grid_(grid), ordering_(order, grid.faces()), room_(room), threads_(threads) {}

  void prepare() override {
    mesh_ = {};
    engine_ = std::make_unique<BenchEngine>(room_, 40 * std::uint64_t{grid_.faces()}, threads_);
    mesh_ = grid_.store(engine_->engine().scratch, ordering_);
    joined_ = 0;
  }
  void run() override {
    visit([](const JoinedFace&) {});
  }
  void check() override {
    expect(joined_ == grid_.faces(), "faces are missing");
    joined_ = 0;
    visit([&](const JoinedFace& face) {
      for (int k = 0; k < 3; ++k) {
        const Position p = grid_.position(raw(face.record.v[k]));
        const TexCoord t = grid_.texcoord(raw(face.record.t[k]));
        expect(face.p[k].x == p.x && face.p[k].y == p.y, "a position is another's");
        expect(face.t[k].u == t.u && face.t[k].v == t.v, "a texture coordinate is another's");
      }
    });
    expect(engine_->kept_to_its_room(), "scratch is not where it should be");
  }

 private:
  template <class Look>
  void visit(Look look) {
    const Engine& engine = engine_->engine();
    StageLog::Stage stage(engine.log, "join");
    std::vector<std::uint64_t> counts(threads_);
    FaceVisitor visitor;
    visitor.transform = [&](std::size_t worker, std::uint64_t, std::span<const JoinedFace> faces) {
      counts[worker] += faces.size();
      for (const JoinedFace& face : faces) look(face);
    };
    visitor.commit = [&](std::size_t worker) { joined_ += std::exchange(counts[worker], 0); };
    Weld none;
    visit_faces(engine, mesh_, none, SpillReader<FaceRecord>::Mode::kKeep,
                engine.budget.free_bytes() / 8 * 7, stage, visitor);
  }

  Grid grid_;
  Ordering ordering_;
  Room room_;
  std::size_t threads_;
  std::unique_ptr<BenchEngine> engine_;
  MeshStore mesh_;
  std::uint64_t joined_ = 0;
};

std::vector<NamedJob> jobs(std::uint64_t size) {
  const auto records = static_cast<std::uint32_t>(size);
  const Grid grid(size);
  std::vector<NamedJob> all;
  for (const Order order : {Order::kMesh, Order::kRandom}) {
    for (const Room room : {Room::kInMemory, Room::kBeyondMemory}) {
      all.push_back({std::string("gather/") + name_of(order) + "/" + name_of(room),
                     [=] { return std::make_unique<GatherJob>(records, order, room); }, "record",
                     records});
    }
    const std::uint32_t lookups = order == Order::kMesh ? records : records / 64 + 1;
    all.push_back({std::string("page_cache/") + name_of(order) + "/beyond_memory",
                   [=] { return std::make_unique<PageCacheJob>(records, order, lookups); },
                   "record", lookups});
    for (const Room room : {Room::kInMemory, Room::kBeyondMemory}) {
      for (const std::size_t threads : kThreads) {
        all.push_back({std::string("join/") + name_of(order) + "/" + name_of(room) +
                           "/threads:" + std::to_string(threads),
                       [=] { return std::make_unique<JoinJob>(grid, order, room, threads); },
                       "face", grid.faces()});
      }
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  return run_subject(argc, argv, {"RECORDS", 2'000'000, jobs});
}
