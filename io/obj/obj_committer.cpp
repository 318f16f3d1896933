#include "io/obj/obj_committer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "io/model/element_room.hpp"
#include "io/obj/obj_block_parser.hpp"

namespace atlasgauge {
namespace {

constexpr const char* kInvalidKind = "faces invalid";
constexpr const char* kUnknownKind = "unknown statement";
constexpr const char* kNotFiniteKind = "coordinates not finite";

/// ForwardPolygons handed out at a time.
constexpr std::size_t kForwardBatch = 1024;

/// An index that was relative to `before` as an absolute one; kNone if it lies before the start.
template <class Id>
Id absolute(Id relative, std::uint64_t before) {
  const std::int64_t index =
      static_cast<std::int32_t>(raw(relative)) + static_cast<std::int64_t>(before);
  return index < 0 ? kNone<Id> : Id{static_cast<std::uint32_t>(index)};
}

std::uint32_t max_vertex(std::span<const FaceRecord> faces) {
  std::uint32_t max = 0;
  for (const FaceRecord& face : faces) {
    for (const VertexId v : face.v) max = std::max(max, raw(v));
  }
  return max;
}

std::size_t end_of_polygon(const ObjBlock& block, std::size_t polygon) {
  const bool is_last = polygon + 1 == block.polygons.size();
  return is_last ? block.faces.size() : block.polygons[polygon + 1].first_face;
}

bool is_not_finite(ObjDefect defect) {
  return defect == ObjDefect::kPositionNotFinite || defect == ObjDefect::kTexCoordNotFinite;
}

std::uint64_t count_spliced(std::string_view text) {
  return static_cast<std::uint64_t>(std::ranges::count(text, '\v'));
}

/// Nothing in the file is of an OBJ, but what says nothing about a model.
bool is_empty(const ObjSummary& obj) {
  return obj.positions + obj.texcoords + obj.faces + obj.invalid_polygons +
                 obj.skipped_primitives ==
             0 &&
         obj.material_names.empty() && obj.mtllib_lines.empty();
}

}  // namespace

ObjCommitter::ObjCommitter(std::string path, Warnings& warnings)
    : path_(std::move(path)),
      warnings_(warnings),
      materials_(path_),
      libraries_(path_),
      long_line_(path_) {}

void ObjCommitter::commit(ObjBlock& block, MeshSink& sink) {
  if (block.kind == ObjBlock::Kind::kWholeLines) {
    commit_lines(block, sink);
  } else {
    commit_piece(block, sink);
  }
}

ObjSummary ObjCommitter::finish() {
  summary_.material_names = materials_.take();
  summary_.mtllib_lines = libraries_.take();
  if (is_empty(summary_)) {
    throw Error(ErrorKind::kInput, path_, 0,
                "found no statement of a Wavefront OBJ model (v, vt, f, ...): the file is empty or "
                "something else; give a model");
  }
  return std::move(summary_);
}

std::vector<std::string> ObjCommitter::take_mtllib_lines() {
  return libraries_.take();
}

void ObjCommitter::commit_lines(ObjBlock& block, MeshSink& sink) {
  for (;;) {
    commit_values(block, sink);
    if (block.fault) {
      throw Error(ErrorKind::kInput, path_, lines_ + block.fault->line + 1, block.fault->text);
    }
    if (block.wide_line_bytes != 0) commit_wide_line(block, sink);
    if (block.rest().empty()) break;
    block.clear_values();
    parse_lines(block);
  }
  lines_ += block.parsed_lines;
}

void ObjCommitter::commit_values(ObjBlock& block, MeshSink& sink) {
  if (block.has_relative) resolve_relative(block);
  set_materials(block);
  for (const ObjBlock::Name& library : block.libraries.items()) {
    libraries_.number_of(block.text_of(library));
  }
  summary_.skipped_primitives += block.skipped_primitives;
  warn_about(block);
  emit({.positions = block.positions.items(),
        .texcoords = block.texcoords.items(),
        .faces = block.faces.items()},
       sink);
  if (max_vertex(block.faces.items()) >= summary_.positions) emit_forward(block, sink);
}

/// Drops the polygons that name a vertex before the first, moving those after them up.
void ObjCommitter::resolve_relative(ObjBlock& block) {
  std::size_t kept_polygons = 0;
  std::size_t kept_faces = 0;
  std::size_t material = 0;
  for (std::size_t i = 0; i < block.polygons.size(); ++i) {
    const auto [first_face, line] = block.polygons[i];
    const std::size_t end_face = end_of_polygon(block, i);
    for (; material < block.materials.size(); ++material) {
      if (block.materials[material].first_face > first_face) break;
      block.materials[material].first_face = static_cast<std::uint32_t>(kept_faces);
    }
    const ObjDefect defect = resolve_polygon(block, first_face, end_face);
    if (defect != ObjDefect::kNone) {
      ++block.invalid_polygons;
      block.oddities.push_back({line, defect, {}});
      continue;
    }
    block.polygons[kept_polygons++] = {static_cast<std::uint32_t>(kept_faces), line};
    std::copy(&block.faces[first_face], block.faces.data() + end_face, &block.faces[kept_faces]);
    kept_faces += end_face - first_face;
  }
  for (; material < block.materials.size(); ++material) {
    block.materials[material].first_face = static_cast<std::uint32_t>(kept_faces);
  }
  block.polygons.resize(kept_polygons);
  block.faces.resize(kept_faces);
}

ObjDefect ObjCommitter::resolve_polygon(ObjBlock& block, std::size_t first_face,
                                        std::size_t end_face) const {
  ObjDefect defect = ObjDefect::kNone;
  for (std::size_t i = first_face; i < end_face; ++i) {
    FaceRecord& face = block.faces[i];
    const std::uint32_t marks = raw(face.material);
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      if ((marks & ObjBlock::kRelativeVertex << corner) != 0) {
        face.v[corner] = absolute(face.v[corner], summary_.positions);
        if (face.v[corner] == kNone<VertexId>) defect = ObjDefect::kNoSuchVertex;
      }
      if ((marks & ObjBlock::kRelativeTexCoord << corner) != 0) {
        face.t[corner] = absolute(face.t[corner], summary_.texcoords);
      }
    }
  }
  return defect;
}

void ObjCommitter::set_materials(ObjBlock& block) {
  std::size_t face = 0;
  for (const auto& [first_face, name] : block.materials.items()) {
    for (; face < first_face; ++face) block.faces[face].material = material_;
    material_ = MaterialId{materials_.number_of(block.text_of(name))};
  }
  for (; face < block.faces.size(); ++face) block.faces[face].material = material_;
}

void ObjCommitter::warn_about(ObjBlock& block) {
  std::ranges::stable_sort(block.oddities, {}, &ObjBlock::Oddity::line);
  std::uint64_t unknown = 0;
  std::uint64_t invalid = 0;
  std::uint64_t not_finite = 0;
  for (const auto& [line, defect, keyword] : block.oddities) {
    const std::uint64_t file_line = lines_ + line + 1;
    if (defect == ObjDefect::kNone) {
      ++unknown;
      warnings_.add(kUnknownKind, path_, file_line, unknown_statement(block.text_of(keyword)));
    } else {
      ++(is_not_finite(defect) ? not_finite : invalid);
      warn_about(defect, file_line);
    }
  }
  warnings_.count(kUnknownKind, block.unknown_statements - unknown);
  warnings_.count(kInvalidKind, block.invalid_polygons - invalid);
  warnings_.count(kNotFiniteKind, block.not_finite - not_finite);
  summary_.unknown_statements += block.unknown_statements;
  summary_.invalid_polygons += block.invalid_polygons;
}

void ObjCommitter::warn_about(ObjDefect defect, std::uint64_t line) {
  const char* const kind = is_not_finite(defect) ? kNotFiniteKind : kInvalidKind;
  warnings_.add(kind, path_, line, std::string(defect_text(defect)));
}

void ObjCommitter::emit_forward(const ObjBlock& block, MeshSink& sink) {
  const std::uint64_t faces_before = summary_.faces - block.faces.size();
  std::vector<ForwardPolygon> forward;
  for (std::size_t i = 0; i < block.polygons.size(); ++i) {
    const auto [first_face, line] = block.polygons[i];
    const std::size_t face_count = end_of_polygon(block, i) - first_face;
    const std::uint32_t vertex = max_vertex(block.faces.items().subspan(first_face, face_count));
    if (vertex < summary_.positions) continue;
    forward.push_back({faces_before + first_face, face_count, vertex, lines_ + line + 1});
    if (forward.size() < kForwardBatch) continue;
    emit({.forward = forward}, sink);
    forward.clear();
  }
  if (!forward.empty()) emit({.forward = forward}, sink);
}

void ObjCommitter::commit_wide_line(ObjBlock& block, MeshSink& sink) {
  const std::string_view text = block.rest().substr(0, block.wide_line_bytes);
  const std::uint64_t line = lines_ + block.parsed_lines + 1;
  long_line_.begin(here(line));
  feed_long_line(text, block, sink);
  end_long_line(line, sink);
  block.parsed_bytes += text.size();
  ++block.parsed_lines;
  if (block.spliced) block.parsed_lines += static_cast<std::uint32_t>(count_spliced(text));
}

void ObjCommitter::commit_piece(ObjBlock& block, MeshSink& sink) {
  if (!long_line_begin_) {
    long_line_begin_ = lines_ + 1;
    long_line_.begin(here(*long_line_begin_));
  }
  feed_long_line(block.rest(), block, sink);
  if (block.spliced) lines_ += count_spliced(block.rest());
  if (block.kind == ObjBlock::Kind::kPiece) return;

  ++lines_;
  end_long_line(*long_line_begin_, sink);
  long_line_begin_.reset();
}

ObjLongLine::Before ObjCommitter::here(std::uint64_t line) const {
  return {line, summary_.positions, summary_.texcoords, material_};
}

/// The block's room for faces serves as the buffer.
void ObjCommitter::feed_long_line(std::string_view text, ObjBlock& block, MeshSink& sink) {
  const char* p = text.data();
  const char* const end = p + text.size();
  while (p != end) {
    block.faces.resize(0);
    p = long_line_.feed(p, end, block.faces);
    if (block.faces.size() != 0) emit({.faces = block.faces.items()}, sink);
  }
  block.faces.resize(0);
}

void ObjCommitter::end_long_line(std::uint64_t line, MeshSink& sink) {
  switch (long_line_.statement()) {
    case ObjStatement::kPosition:
      if (!is_finite(long_line_.position())) warn_about(ObjDefect::kPositionNotFinite, line);
      return emit({.positions = {&long_line_.position(), 1}}, sink);
    case ObjStatement::kTexCoord:
      if (!is_finite(long_line_.texcoord())) warn_about(ObjDefect::kTexCoordNotFinite, line);
      return emit({.texcoords = {&long_line_.texcoord(), 1}}, sink);
    case ObjStatement::kFace:
      return end_long_polygon(line, sink);
    case ObjStatement::kMaterial:
      material_ = MaterialId{materials_.number_of(long_line_.text())};
      return;
    case ObjStatement::kLibrary:
      libraries_.number_of(long_line_.text());
      return;
    case ObjStatement::kPrimitive:
      ++summary_.skipped_primitives;
      return;
    case ObjStatement::kUnknown:
      ++summary_.unknown_statements;
      return warnings_.add(kUnknownKind, path_, line, unknown_statement(long_line_.text()));
    case ObjStatement::kIgnored:
      return;
  }
}

/// A defect may show when triangles were handed out already: these are then withdrawn as a
/// polygon that names a vertex that cannot exist.
void ObjCommitter::end_long_polygon(std::uint64_t line, MeshSink& sink) {
  const ObjDefect defect = long_line_.defect();
  const std::uint64_t triangles = long_line_.triangles();
  if (triangles == 0) {
    ++summary_.invalid_polygons;
    return warn_about(defect, line);
  }
  const bool is_whole = defect == ObjDefect::kNone;
  if (is_whole && long_line_.max_vertex() < summary_.positions) return;
  const ForwardPolygon polygon{
      summary_.faces - triangles, triangles,
      is_whole ? long_line_.max_vertex() : std::numeric_limits<std::uint64_t>::max(), line};
  emit({.forward = {&polygon, 1}}, sink);
}

void ObjCommitter::emit(const MeshBatch& batch, MeshSink& sink) {
  check_room(path_, "positions", summary_.positions, batch.positions.size());
  check_room(path_, "texture coordinates", summary_.texcoords, batch.texcoords.size());
  check_room(path_, "triangles", summary_.faces, batch.faces.size());
  summary_.positions += batch.positions.size();
  summary_.texcoords += batch.texcoords.size();
  summary_.faces += batch.faces.size();
  sink.add(batch);
}

}  // namespace atlasgauge
