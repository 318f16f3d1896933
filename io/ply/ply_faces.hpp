#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/model/part_batches.hpp"
#include "io/ply/ply_cursor.hpp"
#include "io/ply/ply_layout.hpp"

namespace atlasgauge {

/// Polygons of this many corners are held until all their properties are read, so these may stand
/// in any order. Those with more pass through, see PlyFaces::pass_polygon.
inline constexpr std::size_t kMaxHeldCorners = 4096;

/// Reads records of the element face.
template <class Cursor>
class PlyFaces {
 public:
  static constexpr std::size_t kMemoryBytes =
      kMaxHeldCorners * (sizeof(VertexId) + sizeof(TexCoord));

  PlyFaces(Cursor& cursor, const PlyPlace& place, const PlyLayout& layout, PartBatches& batches)
      : cursor_(cursor), place_(place), layout_(layout), batches_(batches) {}

  void read_record() {
    corners_ = texcoord_values_ = 0;
    has_indices_ = has_texcoords_ = has_passed_ = texcoords_have_passed_ = false;
    texnumber_.reset();
    const std::vector<PlyProperty>& properties = place_.element->properties;
    for (std::size_t i = 0; i < properties.size(); ++i) read_property(i, properties[i]);
    if (!has_passed_) emit_held();
  }

  /// Polygons whose list of texture coordinates had a wrong length.
  std::uint64_t wrong_texcoords() const { return wrong_texcoords_; }

 private:
  void read_property(std::size_t i, const PlyProperty& property) {
    if (i == layout_.face_indices) return read_indices(property);
    if (i == layout_.face_texcoord) return read_texcoords(property);
    if (i == layout_.face_texnumber) {
      texnumber_ = cursor_.integer(property.type);
      return;
    }
    const std::uint64_t values = property.is_list() ? cursor_.length(*property.count_type) : 1;
    cursor_.skip(property.type, values);
  }

  VertexId next_vertex(PlyType type) {
    const std::int64_t index = cursor_.integer(type);
    const bool exists = index >= 0 && static_cast<std::uint64_t>(index) < layout_.vertices;
    return exists ? VertexId{static_cast<std::uint32_t>(index)} : kNone<VertexId>;
  }

  TexCoord next_texcoord(PlyType type) {
    const float u = cursor_.real32(type);
    return {u, cursor_.real32(type)};
  }

  void read_indices(const PlyProperty& property) {
    has_indices_ = true;
    corners_ = cursor_.length(*property.count_type);
    if (corners_ > kMaxHeldCorners) return pass_polygon(property.type);
    held_corners_.resize(corners_);
    for (VertexId& v : held_corners_) v = next_vertex(property.type);
  }

  void read_texcoords(const PlyProperty& property) {
    has_texcoords_ = true;
    texcoord_values_ = cursor_.length(*property.count_type);
    if (has_passed_ && texcoord_values_ != 2 * corners_) {
      refuse_passed(
          fmt::format("{} values in its list texcoord, expected two a corner", texcoord_values_));
    }
    if (has_passed_) return pass_texcoords(property.type);
    if (texcoord_values_ <= 2 * kMaxHeldCorners) return hold_texcoords(property.type);
    if (has_indices_) return cursor_.skip(property.type, texcoord_values_);
    first_texcoord_ = batches_.texcoords();
    texcoords_have_passed_ = true;
    pass_texcoords(property.type);
  }

  void hold_texcoords(PlyType type) {
    held_texcoords_.resize(texcoord_values_ / 2);
    for (TexCoord& t : held_texcoords_) t = next_texcoord(type);
    cursor_.skip(type, texcoord_values_ % 2);
  }

  void pass_texcoords(PlyType type) {
    for (std::uint64_t i = 0; i < texcoord_values_ / 2; ++i) {
      batches_.add(next_texcoord(type), cursor_.line());
    }
    cursor_.skip(type, texcoord_values_ % 2);
  }

  MaterialId material() const {
    if (layout_.textures == 0) return layout_.has_own_image ? MaterialId{0} : kNone<MaterialId>;
    if (!layout_.face_texnumber) return MaterialId{0};
    const std::int64_t number = texnumber_.value_or(-1);
    const bool exists = number >= 0 && static_cast<std::uint64_t>(number) < layout_.textures;
    return exists ? MaterialId{static_cast<std::uint32_t>(number)} : kNone<MaterialId>;
  }

  /// Texture coordinate of a corner, which has number `corner` in its polygon.
  TexCoordId texcoord_of(VertexId v, std::uint64_t corner) const {
    if (layout_.vertices_have_uv) return TexCoordId{raw(v)};
    if (!first_texcoord_) return kNone<TexCoordId>;
    const std::uint64_t index = *first_texcoord_ + corner;
    return index <= kMaxElements ? TexCoordId{static_cast<std::uint32_t>(index)}
                                 : kNone<TexCoordId>;
  }

  FaceRecord triangle(const VertexId (&v)[3], std::uint64_t last, MaterialId material) const {
    return {{v[0], v[1], v[2]},
            {texcoord_of(v[0], 0), texcoord_of(v[1], last - 1), texcoord_of(v[2], last)},
            material};
  }

  void emit_held() {
    const auto exists = [](VertexId v) { return v != kNone<VertexId>; };
    if (corners_ < 3) return drop("it has fewer than three corners");
    if (!std::ranges::all_of(held_corners_, exists)) {
      return drop("it names a vertex that does not exist");
    }
    add_held_texcoords();
    const MaterialId its_material = material();
    for (std::uint64_t last = 2; last < corners_; ++last) {
      batches_.add(triangle({held_corners_[0], held_corners_[last - 1], held_corners_[last]}, last,
                            its_material));
    }
  }

  void drop(const char* why) { batches_.drop_polygon(why, cursor_.line()); }

  void add_held_texcoords() {
    const bool fits = layout_.face_texcoord && texcoord_values_ == 2 * corners_;
    if (!fits) {
      first_texcoord_.reset();
      wrong_texcoords_ += texcoord_values_ == 0 ? 0 : 1;
      return;
    }
    first_texcoord_ = batches_.texcoords();
    for (const TexCoord& t : held_texcoords_) batches_.add(t, cursor_.line());
  }

  /// Hands out the triangles of a polygon while its list of indices is read. Its texture
  /// coordinates may have been handed out before, or will be after; its number of a texture must
  /// stand before.
  void pass_polygon(PlyType type) {
    has_passed_ = true;
    if (layout_.textures != 0 && layout_.face_texnumber && !texnumber_) {
      refuse_passed("its texnumber behind its list of indices, expected it before");
    }
    place_texcoords();
    const MaterialId its_material = material();
    VertexId v[3] = {next_vertex(type), next_vertex(type), {}};
    bool exists = v[0] != kNone<VertexId> && v[1] != kNone<VertexId>;
    std::uint64_t triangles = 0;
    for (std::uint64_t last = 2; last < corners_; ++last) {
      v[2] = next_vertex(type);
      exists = exists && v[2] != kNone<VertexId>;
      if (exists) {
        batches_.add(triangle(v, last, its_material));
        ++triangles;
      }
      v[1] = v[2];
    }
    if (exists) return;
    if (triangles == 0) return drop("it names a vertex that does not exist");
    batches_.withdraw_polygon(triangles, cursor_.line());
  }

  void place_texcoords() {
    if (!layout_.face_texcoord || (has_texcoords_ && texcoord_values_ != 2 * corners_)) {
      first_texcoord_.reset();
      wrong_texcoords_ += texcoord_values_ == 0 ? 0 : 1;
    } else if (!texcoords_have_passed_) {
      first_texcoord_ = batches_.texcoords();
    }
  }

  [[noreturn]] void refuse_passed(const std::string& what) const {
    throw Error(ErrorKind::kInput, place_.path, cursor_.line(),
                fmt::format("found polygon {} of {} corners with {} for polygons of more than {} "
                            "corners; triangulate the model",
                            place_.record + 1, corners_, what, kMaxHeldCorners));
  }

  Cursor& cursor_;
  const PlyPlace& place_;
  const PlyLayout& layout_;
  PartBatches& batches_;

  std::uint64_t corners_ = 0;
  std::uint64_t texcoord_values_ = 0;
  bool has_indices_ = false;
  bool has_texcoords_ = false;
  bool has_passed_ = false;             ///< the polygon was handed out
  bool texcoords_have_passed_ = false;  ///< its texture coordinates were, from first_texcoord_ on
  std::optional<std::int64_t> texnumber_;
  std::optional<std::uint64_t> first_texcoord_;
  std::vector<VertexId> held_corners_;
  std::vector<TexCoord> held_texcoords_;
  std::uint64_t wrong_texcoords_ = 0;
};

}  // namespace atlasgauge
