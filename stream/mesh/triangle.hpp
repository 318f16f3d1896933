#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "io/ids.hpp"
#include "io/mesh_batch.hpp"

namespace atlasgauge {

/// "No UV", in the one bit pattern that chart identity compares.
inline constexpr TexCoord kNoTexCoord{std::numeric_limits<float>::quiet_NaN(),
                                      std::numeric_limits<float>::quiet_NaN()};

/// Bits that order and identify texture coordinates; readers store -0 as +0.
inline std::uint64_t bits_of(const TexCoord& t) {
  return std::bit_cast<std::uint64_t>(t);
}

/// The box of some UVs.
struct UvBox {
  float low_u = 0, low_v = 0, high_u = 0, high_v = 0;
  bool empty = true;

  void add(const TexCoord& t) {
    if (empty) {
      low_u = high_u = t.u;
      low_v = high_v = t.v;
      empty = false;
      return;
    }
    low_u = std::min(low_u, t.u);
    low_v = std::min(low_v, t.v);
    high_u = std::max(high_u, t.u);
    high_v = std::max(high_v, t.v);
  }

  void merge(const UvBox& other) {
    if (other.empty) return;
    add({other.low_u, other.low_v});
    add({other.high_u, other.high_v});
  }
};

/// A point in the texel grid of a slot, v up.
struct Texel {
  double x, y;
};

/// Whether a point is too far from the texture to be drawn (SPEC section 1).
inline bool is_far(const Texel& texel) {
  constexpr double kFarTexels = 1073741824.0;  // 2^30
  return std::abs(texel.x) > kFarTexels || std::abs(texel.y) > kFarTexels;
}

/// What of a texture slot turns UVs into texels.
struct SlotFrame {
  bool has_size = false;
  bool readable = false;
  double width = 0, height = 0;     ///< texels
  double shift_u = 0, shift_v = 0;  ///< whole-texture integer shift (SPEC section 1)

  Texel texel(const TexCoord& t) const {
    return {(static_cast<double>(t.u) + shift_u) * width,
            (static_cast<double>(t.v) + shift_v) * height};
  }
};

/// The frames by SlotId; no slot has no size.
class SlotFrames {
 public:
  static std::uint64_t memory_bytes(std::size_t slots) { return slots * sizeof(SlotFrame); }

  SlotFrames() = default;
  explicit SlotFrames(std::vector<SlotFrame> frames) : frames_(std::move(frames)) {}
  const SlotFrame& of(SlotId slot) const {
    return slot == kNone<SlotId> ? none_ : frames_[raw(slot)];
  }
  std::vector<SlotFrame>& all() { return frames_; }
  const std::vector<SlotFrame>& all() const { return frames_; }

 private:
  std::vector<SlotFrame> frames_;
  SlotFrame none_;
};

enum class FaceKind : std::uint8_t {
  kWhole,             ///< at all levels
  kWeldedDegenerate,  ///< two corners coincide: at the raw level only
  kNonFinite,         ///< at no level
  kDegenerate,        ///< names a vertex twice: at no level
};

/// A face with all that its corners name.
struct Triangle {
  FaceId face;
  SlotId slot;
  FaceKind kind;
  bool slot_has_size;
  bool has_uv_triangle;  ///< three finite UVs, on a slot with a size
  bool uv_far;           ///< reaches beyond 2^30 texels
  VertexId v[3];         ///< as written
  VertexId w[3];         ///< welded
  Position p[3];
  TexCoord t[3];   ///< as in the file, or kNoTexCoord
  Texel texel[3];  ///< where has_uv_triangle
  double area_3d;  ///< model units squared
  double area_uv;  ///< signed, texels squared; 0 without a UV triangle

  bool at_raw_level() const {
    return kind == FaceKind::kWhole || kind == FaceKind::kWeldedDegenerate;
  }
  bool at_welded_level() const { return kind == FaceKind::kWhole; }
};

/// Half the length of (p1 - p0) x (p2 - p0), every operation rounded for itself.
double triangle_area(const Position& p0, const Position& p1, const Position& p2);

/// Half of (x1 - x0)(y2 - y0) - (x2 - x0)(y1 - y0).
double signed_area(const Texel& t0, const Texel& t1, const Texel& t2);

double distance(const Position& a, const Position& b);
double distance(const Texel& a, const Texel& b);

}  // namespace atlasgauge
