#include "stream/mesh/mesh_store.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "stream/mesh/triangle.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kLargestBlockBytes = 1 << 20;
constexpr std::size_t kSmallestBlockBytes = 4 << 10;

/// Puts batches into scratch and notes global facts on the way.
class StoringSink : public MeshSink {
 public:
  StoringSink(Scratch& scratch, LastUses last_faces)
      : scratch_(scratch),
        positions_(scratch),
        texcoords_(scratch),
        faces_(scratch),
        forward_(scratch) {
    store_.last_faces = std::move(last_faces);
  }

  void add(const MeshBatch& batch) override {
    for (const Position& p : batch.positions) note(p);
    for (const TexCoord& t : batch.texcoords) note(t);
    positions_.append(batch.positions);
    texcoords_.append(batch.texcoords);
    note_last_faces(batch.faces, faces_.size(), store_.last_faces);
    faces_.append(batch.faces);
    forward_.append(batch.forward);
  }

  MeshStore finish(const std::string& path, Warnings& warnings) {
    store_.positions = positions_.finish();
    store_.texcoords = texcoords_.finish();
    store_.faces = faces_.finish();
    Spill<ForwardPolygon> forward = forward_.finish();
    if (!forward.empty()) drop_invalid(forward, path, warnings);
    return std::move(store_);
  }

 private:
  void note(const Position& p) {
    if (is_finite(p)) {
      store_.box.add(p);
    } else {
      ++store_.nonfinite_positions;
    }
  }

  void note(const TexCoord& t) {
    const bool inside = t.u >= 0 && t.u <= 1 && t.v >= 0 && t.v <= 1;
    if (!inside && is_finite(t)) store_.uvs_in_unit_square = false;
  }

  /// Rewrites the faces without those of polygons that name a vertex which never came.
  void drop_invalid(Spill<ForwardPolygon>& forward, const std::string& path, Warnings& warnings) {
    SpillReader<ForwardPolygon> polygons(forward);
    SpillReader<FaceRecord> faces(store_.faces, SpillReader<FaceRecord>::Mode::kConsume);
    SpillWriter<FaceRecord> kept(scratch_);
    std::uint64_t face = 0;
    const auto copy_until = [&](std::uint64_t end, bool keep) {
      FaceRecord record{};
      while (face < end && faces.read(record)) {
        if (keep) kept.push(record);
        ++face;
      }
    };
    ForwardPolygon polygon{};
    while (polygons.read(polygon)) {
      if (polygon.max_vertex < store_.positions.size()) continue;
      copy_until(polygon.first_face, true);
      copy_until(polygon.first_face + polygon.face_count, false);
      ++store_.invalid_polygons;
      warnings.add("faces invalid", path, polygon.line,
                   "the face names a vertex that the file does not have; it is left out");
    }
    copy_until(store_.faces.size(), true);
    store_.faces = kept.finish();
  }

  Scratch& scratch_;
  MeshStore store_;
  SpillWriter<Position> positions_;
  SpillWriter<TexCoord> texcoords_;
  SpillWriter<FaceRecord> faces_;
  SpillWriter<ForwardPolygon> forward_;
};

/// The largest block of text whose worst blow-up fits for every worker.
std::size_t choose_block_bytes(std::uint64_t memory_bytes, std::size_t workers) {
  std::size_t block = kLargestBlockBytes;
  while (block > kSmallestBlockBytes && workers * ObjReader::memory_bytes(block) > memory_bytes) {
    block /= 2;
  }
  return block;
}

}  // namespace

void BoundingBox::add(const Position& p) {
  if (std::exchange(empty, false)) {
    low = high = p;
    return;
  }
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

double BoundingBox::longest_side() const {
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

void note_last_faces(std::span<const FaceRecord> faces, std::uint64_t before,
                     LastUses& last_faces) {
  auto items = static_cast<std::uint32_t>(before);
  for (const FaceRecord& face : faces) {
    ++items;
    for (const VertexId v : face.v) last_faces.note(raw(v), items);
  }
}

MeshStore read_mesh(const Engine& engine, const std::string& path, Warnings& warnings,
                    ObjSummary& summary) {
  const std::unique_ptr<ByteSource> source = open_byte_source(path);
  StageLog::Stage stage(engine.log, "read", source->file_bytes());
  LastUses last_faces(engine.budget);
  const std::size_t workers = engine.workers.count();
  const std::uint64_t writers_bytes = 4 * engine.block_bytes();
  const std::uint64_t free_bytes = engine.budget.free_bytes();
  const std::size_t block_bytes =
      choose_block_bytes(free_bytes - std::min(free_bytes, writers_bytes), workers);
  const Reservation memory = engine.budget.reserve(
      writers_bytes + workers * ObjReader::memory_bytes(block_bytes), "reading the model");

  ObjReader reader(*source, path, warnings, block_bytes);
  StoringSink sink(engine.scratch, std::move(last_faces));
  std::vector<ObjBlock> blocks(workers);
  Workers::Pipeline pipeline;
  pipeline.produce = [&](std::size_t worker) { return reader.next(blocks[worker]); };
  pipeline.transform = [&](std::size_t worker) { reader.parse(blocks[worker]); };
  pipeline.commit = [&](std::size_t worker) {
    reader.commit(blocks[worker], sink);
    stage.progress(source->consumed_bytes());
  };
  engine.workers.run(pipeline);
  summary = reader.finish();
  MeshStore store = sink.finish(path, warnings);
  store.invalid_polygons += summary.invalid_polygons;
  return store;
}

}  // namespace atlasgauge
