// What finding coincident vertices costs a vertex.

#include <memory>
#include <string>
#include <vector>

#include "bench/stages/bench_engine.hpp"
#include "bench/stages/job.hpp"
#include "stream/mesh/weld.hpp"

namespace {

using namespace atlasgauge;

/// Vertices of which `distinct` lie at places of their own; the others lie on them in turn.
class WeldJob : public Job {
 public:
  WeldJob(std::uint32_t vertices, std::uint32_t distinct, Room room, std::size_t threads)
      : vertices_(vertices), distinct_(distinct), room_(room), threads_(threads) {}

  void prepare() override {
    weld_ = {};
    mesh_ = {};
    engine_ = std::make_unique<BenchEngine>(room_, vertices_ * sizeof(Position), threads_);
    SpillWriter<Position> writer(engine_->engine().scratch);
    for (std::uint32_t i = 0; i < vertices_; ++i) {
      const std::uint32_t place = i % distinct_;
      const std::uint32_t x = place / 1024, y = place % 1024;
      writer.push({static_cast<double>(x), static_cast<double>(y), 0.25});
    }
    mesh_.positions = writer.finish();
  }
  void run() override { weld_ = weld_vertices(engine_->engine(), mesh_); }
  void check() override {
    expect(weld_.duplicates == vertices_ - distinct_, "duplicates are missing");
    SpillReader<VertexId> reader(weld_.welded);
    VertexId first{};
    std::uint32_t count = 0;
    for (; reader.read(first); ++count) {
      expect(raw(first) == count % distinct_, "a vertex is at another's place");
    }
    expect(count == (weld_.found_any() ? vertices_ : 0), "vertices are missing");
    expect(engine_->kept_to_its_room(), "scratch is not where it should be");
  }

 private:
  std::uint32_t vertices_, distinct_;
  Room room_;
  std::size_t threads_;
  std::unique_ptr<BenchEngine> engine_;
  MeshStore mesh_;
  Weld weld_;
};

std::vector<NamedJob> jobs(std::uint64_t size) {
  const auto vertices = static_cast<std::uint32_t>(size);
  std::vector<NamedJob> all;
  for (const bool some_coincide : {false, true}) {
    const std::uint32_t distinct = some_coincide ? vertices - vertices / 8 : vertices;
    for (const Room room : {Room::kInMemory, Room::kBeyondMemory}) {
      for (const std::size_t threads : kThreads) {
        all.push_back(
            {std::string(some_coincide ? "weld/an_eighth_coincide/" : "weld/none_coincide/") +
                 name_of(room) + "/threads:" + std::to_string(threads),
             [=] { return std::make_unique<WeldJob>(vertices, distinct, room, threads); }, "vertex",
             vertices});
      }
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  return run_subject(argc, argv, {"VERTICES", 2'000'000, jobs});
}
