#include "stream/mesh/face_stream.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "stream/engine/gather.hpp"
#include "stream/engine/page_cache.hpp"
#include "stream/mesh/triangle.hpp"

namespace atlasgauge {
namespace {

/// Faces that a worker takes at a time: many, because taking turns costs far more than a face.
constexpr std::size_t kItemFaces = 4096;
/// Faces that are joined at a time: few, so that they stay in the caches.
constexpr std::size_t kBatchFaces = 128;
/// Gathering writes and reads about this many bytes a face.
constexpr std::uint64_t kGatherBytesPerFace = 600;

/// Where the corners' data come from while one worker joins the batches of an item.
class CornerSource {
 public:
  virtual ~CornerSource() = default;
  /// Whether to go on with it after so many faces. One worker at a time.
  virtual bool pays_off(std::uint64_t /*faces*/) const { return true; }
  /// In face order, one worker at a time.
  virtual void produce(std::size_t worker, std::span<const FaceRecord> faces) = 0;
  /// Any worker; `first` is the place in its item of the first of the faces.
  virtual void join(std::size_t worker, std::size_t first, std::span<JoinedFace> faces) = 0;
};

TexCoord usable(const TexCoord& t) {
  return is_finite(t) ? t : kNoTexCoord;
}

/// Tables in memory, shared by all workers.
class LoadedTables : public CornerSource {
 public:
  static std::uint64_t memory_bytes(const MeshStore& mesh, const Weld& weld) {
    return mesh.positions.size() * sizeof(Position) + mesh.texcoords.size() * sizeof(TexCoord) +
           weld.welded.size() * sizeof(VertexId);
  }

  LoadedTables(MeshStore& mesh, Weld& weld)
      : positions_(load(mesh.positions)),
        texcoords_(load(mesh.texcoords)),
        welded_(load(weld.welded)) {}

  void produce(std::size_t, std::span<const FaceRecord>) override {}

  void join(std::size_t, std::size_t, std::span<JoinedFace> faces) override {
    for (JoinedFace& face : faces) {
      for (int k = 0; k < 3; ++k) {
        const VertexId v = face.record.v[k];
        const TexCoordId t = face.record.t[k];
        face.p[k] = positions_[raw(v)];
        face.welded[k] = welded_.empty() ? v : welded_[raw(v)];
        face.t[k] = raw(t) < texcoords_.size() ? usable(texcoords_[raw(t)]) : kNoTexCoord;
      }
    }
  }

 private:
  template <class T>
  static std::vector<T> load(Spill<T>& table) {
    std::vector<T> all(table.size());
    if (!all.empty()) SpillReader<T>(table).read(all);
    return all;
  }

  std::vector<Position> positions_;
  std::vector<TexCoord> texcoords_;
  std::vector<VertexId> welded_;
};

/// Page caches, one set a worker.
class CachedTables : public CornerSource {
 public:
  /// Shares of one worker's memory: by record size, since faces use the tables about equally.
  struct Shares {
    std::uint64_t positions, texcoords, welded;
    explicit Shares(std::uint64_t worker_bytes)
        : positions(worker_bytes / 8 * 5), texcoords(worker_bytes / 4), welded(worker_bytes / 8) {}

    std::uint32_t position_records() const {
      return PageLayout<Position>::records_for_neighbours(positions);
    }
    std::uint32_t texcoord_records() const {
      return PageLayout<TexCoord>::records_for_neighbours(texcoords);
    }
  };

  CachedTables(MeshStore& mesh, Weld& weld, std::size_t workers, std::uint64_t memory_bytes)
      : texcoords_(mesh.texcoords.size()), least_bytes_(2 * memory_bytes) {
    const Shares shares(memory_bytes / workers);
    for (std::size_t i = 0; i < workers; ++i) {
      caches_.push_back(std::make_unique<Caches>(mesh, weld, shares));
    }
  }

  /// Not if gathering all faces so far had been cheaper than the pages they read, filling the
  /// caches apart.
  bool pays_off(std::uint64_t faces) const override {
    return read_bytes_.load(std::memory_order_relaxed) <=
           least_bytes_ + faces * kGatherBytesPerFace;
  }

  void produce(std::size_t, std::span<const FaceRecord>) override {}

  void join(std::size_t worker, std::size_t, std::span<JoinedFace> faces) override {
    Caches& caches = *caches_[worker];
    const std::uint64_t read_before = caches.read_bytes();
    for (JoinedFace& face : faces) {
      for (int k = 0; k < 3; ++k) {
        const VertexId v = face.record.v[k];
        const TexCoordId t = face.record.t[k];
        face.p[k] = caches.positions.at(raw(v));
        face.welded[k] = caches.welded ? caches.welded->at(raw(v)) : v;
        face.t[k] = raw(t) < texcoords_ ? usable(caches.texcoords->at(raw(t))) : kNoTexCoord;
      }
    }
    read_bytes_.fetch_add(caches.read_bytes() - read_before, std::memory_order_relaxed);
  }

 private:
  struct Caches {
    Caches(MeshStore& mesh, Weld& weld, const Shares& shares)
        : positions(mesh.positions, shares.positions, shares.position_records()) {
      if (!mesh.texcoords.empty()) {
        texcoords.emplace(mesh.texcoords, shares.texcoords, shares.texcoord_records());
      }
      if (weld.found_any()) welded.emplace(weld.welded, shares.welded);
    }
    std::uint64_t read_bytes() const {
      return positions.read_bytes() + (texcoords ? texcoords->read_bytes() : 0) +
             (welded ? welded->read_bytes() : 0);
    }
    PageCache<Position> positions;
    std::optional<PageCache<TexCoord>> texcoords;
    std::optional<PageCache<VertexId>> welded;
  };

  std::uint64_t texcoords_;
  std::uint64_t least_bytes_;
  std::atomic<std::uint64_t> read_bytes_ = 0;
  std::vector<std::unique_ptr<Caches>> caches_;
};

/// Corner data gathered beforehand, in face order, of the faces from `first` on.
class GatheredCorners : public CornerSource {
 public:
  GatheredCorners(const Engine& engine, MeshStore& mesh, Weld& weld, std::uint64_t first)
      : items_(engine.workers.count()) {
    const auto vertex = [](const FaceRecord& face, int k) { return raw(face.v[k]); };
    const auto texcoord = [](const FaceRecord& face, int k) { return raw(face.t[k]); };
    positions_ = gather(engine, indices(mesh, first, vertex), mesh.positions, Position{});
    if (weld.found_any()) {
      welded_ = gather(engine, indices(mesh, first, vertex), weld.welded, kNone<VertexId>);
      welded_reader_.emplace(welded_, kConsume<VertexId>);
    }
    if (!mesh.texcoords.empty()) {
      texcoords_ = gather(engine, indices(mesh, first, texcoord), mesh.texcoords, kNoTexCoord);
      texcoord_reader_.emplace(texcoords_, kConsume<TexCoord>);
    }
    position_reader_.emplace(positions_, kConsume<Position>);
  }

  void produce(std::size_t worker, std::span<const FaceRecord> faces) override {
    Corners& item = items_[worker];
    fill(position_reader_, item.p, 3 * faces.size());
    fill(texcoord_reader_, item.t, 3 * faces.size());
    fill(welded_reader_, item.welded, 3 * faces.size());
  }

  void join(std::size_t worker, std::size_t first, std::span<JoinedFace> faces) override {
    const Corners& item = items_[worker];
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t corner = 3 * (first + i) + k;
        faces[i].p[k] = item.p[corner];
        faces[i].welded[k] = item.welded.empty() ? faces[i].record.v[k] : item.welded[corner];
        faces[i].t[k] = item.t.empty() ? kNoTexCoord : usable(item.t[corner]);
      }
    }
  }

 private:
  struct Corners {
    std::vector<Position> p;
    std::vector<TexCoord> t;
    std::vector<VertexId> welded;
  };
  template <class T>
  static constexpr auto kConsume = SpillReader<T>::Mode::kConsume;

  template <class IndexOf>
  static Spill<std::uint32_t> indices(MeshStore& mesh, std::uint64_t first, IndexOf index_of) {
    SpillWriter<std::uint32_t> indices(*mesh.faces.scratch());
    SpillReader<FaceRecord> reader(mesh.faces, first);
    for (FaceRecord face; reader.read(face);) {
      for (int k = 0; k < 3; ++k) indices.push(index_of(face, k));
    }
    return indices.finish();
  }

  template <class T>
  static void fill(std::optional<SpillReader<T>>& reader, std::vector<T>& to, std::size_t count) {
    if (!reader) return;
    to.resize(count);
    reader->read(to);
  }

  Spill<Position> positions_;
  Spill<TexCoord> texcoords_;
  Spill<VertexId> welded_;
  std::optional<SpillReader<Position>> position_reader_;
  std::optional<SpillReader<TexCoord>> texcoord_reader_;
  std::optional<SpillReader<VertexId>> welded_reader_;
  std::vector<Corners> items_;
};

std::unique_ptr<CornerSource> open_tables(const Engine& engine, MeshStore& mesh, Weld& weld,
                                          std::uint64_t memory_bytes, Reservation& memory) {
  const std::uint64_t tables = LoadedTables::memory_bytes(mesh, weld);
  const bool fit = tables <= memory_bytes;
  memory = engine.budget.reserve(fit ? tables : memory_bytes, "vertex tables");
  if (fit) return std::make_unique<LoadedTables>(mesh, weld);
  return std::make_unique<CachedTables>(mesh, weld, engine.workers.count(), memory_bytes);
}

/// Few in the beginning, so that a source that does not pay off is soon left.
std::size_t item_faces(std::uint64_t faces_before) {
  return std::clamp<std::size_t>(faces_before / 64, kBatchFaces, kItemFaces);
}

struct Item {
  std::uint64_t first_face = 0;
  std::vector<FaceRecord> records;
  std::vector<JoinedFace> joined;  ///< one batch

  void load_batch(std::size_t first) {
    joined.resize(std::min(kBatchFaces, records.size() - first));
    for (std::size_t i = 0; i < joined.size(); ++i) joined[i].record = records[first + i];
  }
};

}  // namespace

void visit_faces(const Engine& engine, MeshStore& mesh, Weld& weld,
                 SpillReader<FaceRecord>::Mode mode, std::uint64_t memory_bytes,
                 StageLog::Stage& stage, const FaceVisitor& visitor) {
  Reservation memory;
  std::unique_ptr<CornerSource> corners = open_tables(engine, mesh, weld, memory_bytes, memory);
  std::vector<Item> items(engine.workers.count());
  SpillReader<FaceRecord> faces(mesh.faces, mode);
  std::uint64_t next_face = 0;
  Workers::Pipeline pipeline;
  pipeline.produce = [&](std::size_t worker) {
    if (!corners->pays_off(next_face)) return false;
    Item& item = items[worker];
    item.records.resize(item_faces(next_face));
    item.records.resize(faces.read(item.records));
    item.first_face = std::exchange(next_face, next_face + item.records.size());
    corners->produce(worker, item.records);
    return !item.records.empty();
  };
  pipeline.transform = [&](std::size_t worker) {
    Item& item = items[worker];
    for (std::size_t first = 0; first < item.records.size(); first += kBatchFaces) {
      item.load_batch(first);
      corners->join(worker, first, item.joined);
      visitor.transform(worker, item.first_face + first, item.joined);
    }
  };
  if (visitor.commit) {
    pipeline.commit = [&](std::size_t worker) {
      visitor.commit(worker);
      stage.progress(items[worker].first_face);
    };
  }
  engine.workers.run(pipeline);
  if (next_face == mesh.faces.size()) return;
  corners.reset();
  memory.release();
  corners = std::make_unique<GatheredCorners>(engine, mesh, weld, next_face);
  engine.workers.run(pipeline);
}

}  // namespace atlasgauge
