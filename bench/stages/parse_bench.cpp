// What reading OBJ text costs: the reader alone, on one thread and from memory, and the stage that
// reads a file into scratch.

#include <algorithm>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/stages/bench_engine.hpp"
#include "bench/stages/grid_text.hpp"
#include "bench/stages/job.hpp"
#include "bench/temp_folder.hpp"
#include "io/obj/obj_reader.hpp"
#include "stream/mesh/read_model.hpp"

namespace {

using namespace atlasgauge;

class TextSource : public ByteSource {
 public:
  explicit TextSource(std::string_view text) : text_(text) {}

  std::size_t read(char* to, std::size_t bytes) override {
    const std::size_t count = std::min(bytes, text_.size() - at_);
    std::memcpy(to, text_.data() + at_, count);
    at_ += count;
    return count;
  }
  std::uint64_t consumed_bytes() const override { return at_; }
  std::uint64_t file_bytes() const override { return text_.size(); }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// Looks at what every batch brings, but at every value only when an answer is wanted.
class TotalsSink : public MeshSink {
 public:
  void add(const MeshBatch& batch) override {
    faces_ += batch.faces.size();
    if (!wants_totals) return;
    for (const Position& p : batch.positions) totals.add(p);
    for (const TexCoord& t : batch.texcoords) totals.add(t);
    for (const FaceRecord& face : batch.faces) totals.add(face);
  }
  std::uint64_t faces() const { return faces_; }

  bool wants_totals = false;
  ObjTotals totals;

 private:
  std::uint64_t faces_ = 0;
};

constexpr std::size_t kTextBlockBytes = 1 << 20;

void parse(std::string_view text, Warnings& warnings, MeshSink& sink) {
  TextSource source(text);
  ObjReader reader(source, "grid.obj", warnings, kTextBlockBytes);
  ObjBlock block;
  while (reader.next(block)) {
    reader.parse(block);
    reader.commit(block, sink);
  }
  reader.finish();
}

class ReaderJob : public Job {
 public:
  explicit ReaderJob(const GridText& grid) : grid_(grid) {}

  void prepare() override { sink_ = {}; }
  void run() override { parse(grid_.text, warnings_, sink_); }
  void check() override {
    expect(sink_.faces() == grid_.totals.faces, "faces are missing");
    TotalsSink all;
    all.wants_totals = true;
    parse(grid_.text, warnings_, all);
    expect(all.totals == grid_.totals, "the values are not those of the text");
  }

 private:
  const GridText& grid_;
  Warnings warnings_{{}, true};  // any is an error
  TotalsSink sink_;
};

template <class T>
void add_all(const Spill<T>& spill, ObjTotals& totals) {
  SpillReader<T> reader(spill);
  for (T value{}; reader.read(value);) totals.add(value);
}

class StageJob : public Job {
 public:
  StageJob(const GridText& grid, std::string path, Room room, std::size_t threads)
      : grid_(grid), path_(std::move(path)), room_(room), threads_(threads) {}

  void prepare() override {
    mesh_ = {};
    engine_ = std::make_unique<BenchEngine>(room_, grid_.text.size(), threads_);
  }
  void run() override {
    mesh_ = read_model(engine_->engine(), {&path_, 1}, open_no_parts, warnings_).mesh;
  }
  void check() override {
    ObjTotals totals;
    add_all(mesh_.positions, totals);
    add_all(mesh_.texcoords, totals);
    add_all(mesh_.faces, totals);
    expect(totals == grid_.totals, "the mesh is not that of the text");
    expect(engine_->kept_to_its_room(), "scratch is not where it should be");
  }

 private:
  const GridText& grid_;
  std::string path_;
  Room room_;
  std::size_t threads_;
  Warnings warnings_{{}, true};  // any is an error
  std::unique_ptr<BenchEngine> engine_;
  MeshStore mesh_;
};

}  // namespace

int main(int argc, char** argv) {
  std::unique_ptr<GridText> grid;
  std::unique_ptr<TempFolder> folder;
  const auto jobs = [&](std::uint64_t faces) {
    grid = std::make_unique<GridText>(Grid(faces));
    folder = std::make_unique<TempFolder>();
    const std::string path = folder->path() + "/grid.obj";
    std::ofstream(path) << grid->text;
    std::vector<NamedJob> all;
    const auto add = [&](const std::string& name, auto make) {
      all.push_back({name, make, "face", grid->totals.faces, grid->text.size()});
    };
    add("reader/threads:1", [&] { return std::make_unique<ReaderJob>(*grid); });
    for (const Room room : {Room::kInMemory, Room::kBeyondMemory}) {
      for (const std::size_t threads : kThreads) {
        add("read/" + name_of(room) + "/threads:" + std::to_string(threads),
            [=, &grid] { return std::make_unique<StageJob>(*grid, path, room, threads); });
      }
    }
    return all;
  };
  return run_subject(argc, argv, {"FACES", 2'000'000, jobs});
}
