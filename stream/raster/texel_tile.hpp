#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace atlasgauge {

/// Texels [x0, x1) x [y0, y1) of one mip level. x and y run as u and v do: y = 0 is the bottom row.
struct TexelRect {
  std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  std::int64_t width() const { return x1 - x0; }
  std::int64_t height() const { return y1 - y0; }
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// Width and height of one mip level, in texels.
struct LevelSize {
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// A rectangle of texels of one level with a halo of one texel, and what covers each: the number of
/// triangles, the highest chart, and whether there are two charts or more.
///
/// Texels are held row by row from the bottom, two words each, in two arrays. The halo is always
/// there; where it lies beyond the level nothing is ever drawn, so its texels stay uncovered.
class TexelTile {
 public:
  /// Set in a word of counts() where two charts or more cover the texel. The number of triangles
  /// below it cannot overflow: a model has fewer than 2^30 faces (io/ids.hpp).
  static constexpr std::uint32_t kSeveralCharts = std::uint32_t{1} << 31;

  /// Words after the last texel of each array, which may be read, and written as they are.
  static constexpr std::size_t kPadding = 8;

  static std::uint64_t memory_bytes(std::int64_t width, std::int64_t height) {
    return static_cast<std::uint64_t>(width + 2) * static_cast<std::uint64_t>(height + 2) * 8 +
           8 * kPadding;
  }

  /// Starts over with the texels of `rect`, none covered. Keeps its memory.
  void reset(const TexelRect& rect, const LevelSize& level);

  /// The texels of the tile, without the halo.
  const TexelRect& rect() const { return rect_; }
  /// Where triangles may be drawn: the tile and its halo, as far as the level goes.
  const TexelRect& window() const { return window_; }

  std::size_t stride() const { return stride_; }
  /// Texels of the tile and its halo.
  std::size_t texels() const { return charts_.size() - kPadding; }
  /// Position of a texel of the tile or its halo in the two arrays.
  std::size_t index(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>(y - rect_.y0 + 1) * stride_ +
           static_cast<std::size_t>(x - rect_.x0 + 1);
  }

  /// By texel: the highest chart that covers it, plus one; 0 where none does.
  std::uint32_t* charts() { return charts_.data(); }
  const std::uint32_t* charts() const { return charts_.data(); }
  /// By texel: the number of triangles, and kSeveralCharts.
  std::uint32_t* counts() { return counts_.data(); }
  const std::uint32_t* counts() const { return counts_.data(); }

  /// Adds `count` > 0 triangles, the highest of whose charts is `chart_plus_one`, to one texel.
  void cover(std::size_t at, std::uint32_t count, std::uint32_t chart_plus_one, bool several) {
    const std::uint32_t before = charts_[at];
    const bool differs = before != 0 && before != chart_plus_one;
    if (before < chart_plus_one) charts_[at] = chart_plus_one;
    counts_[at] = (counts_[at] + count) | (differs || several ? kSeveralCharts : 0);
  }

  /// Adds what was drawn into another tile of the same rectangle.
  void merge(const TexelTile& other);

 private:
  TexelRect rect_, window_;
  std::size_t stride_ = 0;
  std::vector<std::uint32_t> charts_, counts_;
};

}  // namespace atlasgauge
