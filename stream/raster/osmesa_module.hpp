#pragma once

#include <cstdint>
#include <span>

#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// A corner of a triangle: its place in the viewport in 1/256 pixel, and the rank of the triangle's
/// chart among those drawn, below OsmesaCanvas::kNoRank.
struct OsmesaCorner {
  std::uint32_t x, y;
  std::uint32_t rank;
};

/// A picture drawn by OSMesa. It may move between threads but not be used by two at once. What can
/// fail throws Error(kInternal), or Error(kResource) for want of memory.
class OsmesaCanvas {
 public:
  /// Side of the viewport in pixels, the largest there is. The picture lies in its midst: a
  /// triangle within the viewport is never clipped, which would move its edges. A power of two, so
  /// that no place in it is rounded on its way through floats.
  static constexpr std::int64_t kViewport = 16384;

  /// Floats count exactly up to here.
  static constexpr std::uint32_t kNoRank = std::uint32_t{1} << 24;

  /// Pixels of the viewport to the left of (below) a picture of that width (height).
  static constexpr std::int64_t margin(std::int64_t pixels) { return (kViewport - pixels) / 2; }

  /// By pixel: how many triangles cover it, and the highest and the lowest of their ranks; without
  /// any, 0, 0 and kNoRank.
  enum class Layer { kCount, kHighest, kLowest };

  virtual ~OsmesaCanvas() = default;

  /// Starts a picture of at most kViewport x kViewport pixels. Only those of `box` are cleared and
  /// may be drawn and read.
  virtual void start(std::int64_t width, std::int64_t height, const TexelRect& box) = 0;
  /// Draws a triangle for every three corners.
  virtual void draw(std::span<const OsmesaCorner> corners) = 0;
  /// Copies the pixels of `part`, row by row from the bottom.
  virtual void read(Layer layer, const TexelRect& part, float* to) = 0;
};

/// What the module with OSMesa exports, under the name kOsmesaCanvasSymbol. The caller owns the
/// canvas.
using OsmesaCanvasFunction = OsmesaCanvas* (*)();

inline constexpr const char* kOsmesaModuleFile = "atlasgauge_osmesa.so";
inline constexpr const char* kOsmesaCanvasSymbol = "atlasgauge_osmesa_canvas";

}  // namespace atlasgauge
