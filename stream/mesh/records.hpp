#pragma once

#include <cstdint>

#include "io/ids.hpp"
#include "io/mesh_batch.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/triangle.hpp"

// The records that stages exchange through scratch.

namespace atlasgauge {

/// The levels that a face takes part in, in face order.
enum class FaceLevels : std::uint8_t { kNone, kRaw, kRawAndWelded };

inline FaceLevels levels_of(const Triangle& triangle) {
  if (triangle.at_welded_level()) return FaceLevels::kRawAndWelded;
  return triangle.at_raw_level() ? FaceLevels::kRaw : FaceLevels::kNone;
}

/// A face in the atlas, in face order: what charts and raster ask for.
class AtlasFace {
 public:
  AtlasFace() = default;
  explicit AtlasFace(const Triangle& triangle)
      : uv_{triangle.t[0], triangle.t[1], triangle.t[2]},
        bits_((raw(triangle.slot) & kSlotMask) | (triangle.at_welded_level() ? kWelded : 0) |
              (triangle.at_welded_level() && triangle.has_uv_triangle ? kUvTriangle : 0) |
              (triangle.uv_far ? kFar : 0)) {}

  const TexCoord& uv(int corner) const { return uv_[corner]; }
  const TexCoord (&uv() const)[3] { return uv_; }
  SlotId slot() const {
    const std::uint32_t slot = bits_ & kSlotMask;
    return slot == kSlotMask ? kNone<SlotId> : SlotId{slot};
  }
  bool at_welded_level() const { return (bits_ & kWelded) != 0; }
  /// At the welded level, with three finite UVs, on a slot with a size.
  bool has_uv_triangle() const { return (bits_ & kUvTriangle) != 0; }
  bool is_drawn() const { return has_uv_triangle() && (bits_ & kFar) == 0; }
  /// Signed, texels squared; 0 without a UV triangle.
  double area_uv(const SlotFrame& frame) const {
    if (!has_uv_triangle()) return 0;
    return signed_area(frame.texel(uv_[0]), frame.texel(uv_[1]), frame.texel(uv_[2]));
  }

 private:
  static constexpr std::uint32_t kUvTriangle = 1U << 31;
  static constexpr std::uint32_t kFar = 1U << 30;
  static constexpr std::uint32_t kWelded = 1U << 29;
  static constexpr std::uint32_t kSlotMask = kWelded - 1;

  TexCoord uv_[3];
  std::uint32_t bits_ = 0;
};
static_assert(sizeof(AtlasFace) == 28);

/// A uv boundary edge with a length, and the face it bounds.
struct BorderEdge {
  FaceId face;
  std::uint32_t padding;
  double length_texels;
};

/// A welded boundary edge, and the face it bounds.
struct OpenEdge {
  VertexId v[2];  ///< as written by that face
  FaceId face;
};

/// One face's side of a welded edge (lo, hi), lo <= hi. Its two UVs are those of the corners at lo
/// and at hi, so equal bits mean the same uv edge.
struct HalfEdge {
  std::uint32_t lo, hi;
  FaceId face;
  std::uint32_t bits;
  TexCoord uv_lo, uv_hi;
  double length_3d;

  static constexpr std::uint32_t kForward = 1U << 31;         ///< the face runs it from lo to hi
  static constexpr std::uint32_t kRawOnly = 1U << 30;         ///< of a welded-degenerate face
  static constexpr std::uint32_t kUvTriangle = 1U << 29;      ///< its face has a UV triangle
  static constexpr std::uint32_t kUnsampled = 1U << 28;       ///< its face's colours cannot be read
  static constexpr std::uint32_t kSlotMask = kUnsampled - 1;  ///< the slot; all ones for none

  std::uint32_t key() const { return lo; }
  bool forward() const { return (bits & kForward) != 0; }
  bool raw_only() const { return (bits & kRawOnly) != 0; }
  bool has_uv_triangle() const { return (bits & kUvTriangle) != 0; }
  bool sampled() const { return (bits & kUnsampled) == 0; }
  std::uint32_t slot_bits() const { return bits & kSlotMask; }
  SlotId slot() const {
    return slot_bits() == kSlotMask ? kNone<SlotId> : static_cast<SlotId>(slot_bits());
  }
  std::uint32_t raw_at_lo() const { return lo; }
  std::uint32_t raw_at_hi() const { return hi; }
};
static_assert(sizeof(HalfEdge) == 40);

/// The same where vertices were welded: the vertices as written ride along. For lo = hi (an edge
/// between coincident vertices) raw_lo is the smaller of them.
struct WeldedHalfEdge : HalfEdge {
  std::uint32_t raw_lo, raw_hi;

  std::uint32_t raw_at_lo() const { return raw_lo; }
  std::uint32_t raw_at_hi() const { return raw_hi; }
};
static_assert(sizeof(WeldedHalfEdge) == 48);

/// A seam edge, unless one of its faces turns out to be in a null chart. Its sides are in the order
/// of slot and UVs.
struct SeamCandidate {
  VertexId v[2];  ///< welded, the lower first
  FaceId faces[2];
  SeamSide sides[2];
  double length_3d;
  bool sampled;
  bool runs_down[2];  ///< the face of this side runs the edge from v[1] to v[0]
};
static_assert(sizeof(SeamCandidate) == 72);

}  // namespace atlasgauge
