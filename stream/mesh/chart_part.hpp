#pragma once

#include <algorithm>
#include <cstdint>

#include "stream/mesh/records.hpp"

namespace atlasgauge {

/// A term of a chart: faces of it that are alike (turned the same way, with UV areas of one sign),
/// or one of its border edges. The areas of the faces may be shared out to several parts, of which
/// all but one have no faces.
struct ChartPart {
  std::uint32_t chart;
  std::uint32_t first_face_and_flags;
  std::uint32_t slot_and_flags;
  std::uint32_t faces;
  float low_u, low_v, high_u, high_v;  ///< of the faces with a UV triangle; 0 without
  double area_uv;                      ///< signed, texels squared
  double area_3d_or_length;            ///< length in texels of a border

  static constexpr std::uint32_t kFlipped = 1U << 30;
  static constexpr std::uint32_t kConflict = 1U << 31;
  static constexpr std::uint32_t kBorder = 1U << 31;
  static constexpr std::uint32_t kUvTriangles = 1U << 30;
  static constexpr std::uint32_t kNegative = 1U << 29;
  static constexpr std::uint32_t kNoArea = 1U << 28;
  static constexpr std::uint32_t kNoSlot = kNoArea - 1;

  static ChartPart of_border(std::uint32_t chart, double length_texels) {
    return {chart, 0, kBorder, 0, 0, 0, 0, 0, 0, length_texels};
  }

  std::uint32_t key() const { return chart; }
  std::uint32_t first_face() const { return first_face_and_flags & ~(kFlipped | kConflict); }
  bool flipped() const { return (first_face_and_flags & kFlipped) != 0; }
  bool conflict() const { return (first_face_and_flags & kConflict) != 0; }
  bool is_border() const { return (slot_and_flags & kBorder) != 0; }
  bool has_uv_triangles() const { return (slot_and_flags & kUvTriangles) != 0; }
  bool is_negative() const { return (slot_and_flags & kNegative) != 0; }
  /// UV areas of 0. Only these faces follow one another without a gap.
  bool has_no_area() const { return (slot_and_flags & kNoArea) != 0; }
  SlotId slot() const {
    const std::uint32_t slot = slot_and_flags & kNoSlot;
    return slot == kNoSlot ? kNone<SlotId> : SlotId{slot};
  }

  bool is_like(const ChartPart& other) const {
    return chart == other.chart && slot_and_flags == other.slot_and_flags &&
           first_face_and_flags >> 30 == other.first_face_and_flags >> 30;
  }
};
static_assert(sizeof(ChartPart) == 48);

}  // namespace atlasgauge
