#include "stream/mesh/part_sink.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/model/element_room.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kShiftedFaces = 1024;

/// Where `id` of a part lies in the model. One beyond all numbers stays beyond all elements.
template <class Id>
Id moved(Id id, std::uint64_t by) {
  if (id == kNone<Id>) return id;
  return Id{static_cast<std::uint32_t>(std::min<std::uint64_t>(raw(id) + by, raw(kNone<Id>)))};
}

}  // namespace

PartSink::PartSink(const Engine& engine, Warnings& warnings)
    : engine_(engine),
      warnings_(warnings),
      positions_(engine.scratch),
      texcoords_(engine.scratch),
      faces_(engine.scratch),
      dropped_(engine.scratch) {
  store_.last_faces = LastUses(engine.budget);
}

void PartSink::begin_part(const std::string& path, std::uint64_t first_material, bool alone) {
  begin_ = {path, positions_.size(), texcoords_.size(), faces_.size(), first_material, alone};
  end_texcoord_named_ = 0;
  forward_.reset();
  make_room_for_part();
}

void PartSink::add(const MeshBatch& batch) {
  check_room(begin_.path, "positions", positions_.size(), batch.positions.size());
  check_room(begin_.path, "texture coordinates", texcoords_.size(), batch.texcoords.size());
  check_room(begin_.path, "triangles", faces_.size(), batch.faces.size());
  for (const Position& p : batch.positions) note(p);
  for (const TexCoord& t : batch.texcoords) note(t);
  positions_.append(batch.positions);
  texcoords_.append(batch.texcoords);
  add_faces(batch.faces);
  store_.invalid_polygons += batch.invalid_polygons;
  if (batch.forward.empty()) return;
  if (!forward_) forward_.emplace(engine_.scratch);
  forward_->append(batch.forward);
}

void PartSink::end_part(double position_step) {
  if (forward_) drop_polygons_of_no_vertex();
  if (end_texcoord_named_ > texcoords_.size() - begin_.texcoords) {
    loose_.push_back({begin_.faces, faces_.size(), texcoords_.size()});
  }
  store_.parts.push_back({begin_.faces, position_step});
}

MeshStore PartSink::finish() {
  store_.positions = positions_.finish();
  store_.texcoords = texcoords_.finish();
  store_.faces = faces_.finish();
  if (dropped_.size() > 0 || !loose_.empty()) rewrite_faces();
  return std::move(store_);
}

void PartSink::make_room_for_part() {
  constexpr std::size_t kFirst = 64;
  if (store_.parts.size() < store_.parts.capacity()) return;
  const std::size_t parts = std::max(kFirst, 2 * store_.parts.size());
  Reservation memory =
      engine_.budget.reserve(parts * sizeof(PartStart), "a model of so many parts");
  store_.parts.reserve(parts);
  store_.parts_memory = std::move(memory);
}

void PartSink::note(const Position& p) {
  if (is_finite(p)) store_.box.add(p);
}

void PartSink::note(const TexCoord& t) {
  const bool inside = t.u >= 0 && t.u <= 1 && t.v >= 0 && t.v <= 1;
  if (!inside && is_finite(t)) store_.uvs_in_unit_square = false;
}

void PartSink::add_faces(std::span<const FaceRecord> faces) {
  if (begin_.alone) return append(faces);
  for (; !faces.empty(); faces = faces.subspan(shifted_.size())) {
    shifted_.clear();
    for (const FaceRecord& face : faces.first(std::min(kShiftedFaces, faces.size()))) {
      shifted_.push_back(shifted(face));
    }
    append(shifted_);
  }
}

void PartSink::append(std::span<const FaceRecord> faces) {
  note_last_faces(faces, faces_.size(), store_.last_faces);
  faces_.append(faces);
}

FaceRecord PartSink::shifted(FaceRecord face) {
  for (int k = 0; k < 3; ++k) {
    face.v[k] = moved(face.v[k], begin_.positions);
    if (face.t[k] == kNone<TexCoordId>) continue;
    end_texcoord_named_ = std::max<std::uint64_t>(end_texcoord_named_, raw(face.t[k]) + 1ULL);
    face.t[k] = moved(face.t[k], begin_.texcoords);
  }
  face.material = moved(face.material, begin_.materials);
  return face;
}

void PartSink::drop_polygons_of_no_vertex() {
  Spill<ForwardPolygon> forward = forward_->finish();
  forward_.reset();
  SpillReader<ForwardPolygon> polygons(forward, SpillReader<ForwardPolygon>::Mode::kConsume);
  const std::uint64_t positions = positions_.size() - begin_.positions;
  for (ForwardPolygon polygon{}; polygons.read(polygon);) {
    if (polygon.max_vertex < positions) continue;
    dropped_.push({begin_.faces + polygon.first_face, polygon.face_count});
    ++store_.invalid_polygons;
    warnings_.add("faces invalid", begin_.path, polygon.line,
                  "the face names a vertex that the file does not have; it is left out");
  }
}

/// Once more from scratch to scratch, as such faces are rare.
void PartSink::rewrite_faces() {
  constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
  Spill<Dropped> all_dropped = dropped_.finish();
  SpillReader<Dropped> dropped(all_dropped);
  SpillReader<FaceRecord> faces(store_.faces, SpillReader<FaceRecord>::Mode::kConsume);
  SpillWriter<FaceRecord> kept(engine_.scratch);
  const auto next_dropped = [&] {
    Dropped next{};
    return dropped.read(next) ? next : Dropped{kNever, 0};
  };
  Dropped drop = next_dropped();
  auto loose = loose_.begin();
  auto part = store_.parts.begin();
  FaceRecord face{};
  for (std::uint64_t i = 0; faces.read(face); ++i) {
    for (; part != store_.parts.end() && part->first_face == i; ++part) {
      part->first_face = kept.size();
    }
    while (i >= drop.first && i - drop.first >= drop.count) drop = next_dropped();
    while (loose != loose_.end() && i >= loose->end_face) ++loose;
    if (i >= drop.first) continue;
    if (loose != loose_.end() && i >= loose->first_face) {
      for (TexCoordId& t : face.t) t = raw(t) < loose->end_texcoord ? t : kNone<TexCoordId>;
    }
    kept.push(face);
  }
  for (; part != store_.parts.end(); ++part) part->first_face = kept.size();
  store_.faces = kept.finish();
}

}  // namespace atlasgauge
