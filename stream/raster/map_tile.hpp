#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "stream/raster/raster.hpp"
#include "stream/raster/row_spans.hpp"
#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// What a map shows of one face.
struct FaceLook {
  std::uint32_t face;
  float scaling;     ///< s_f, or 0 where it does not exist
  float distortion;  ///< qcd, or 0
  float sign;        ///< of the UV area: 1, -1 or 0
};

/// The texels of one tile of a map, rows from the top down, each as long as the tile size. A texel
/// shows the face with the highest number in the highest chart that covers it.
class MapTile {
 public:
  static std::uint64_t memory_bytes(std::int64_t tile_size) {
    return static_cast<std::uint64_t>(tile_size) * static_cast<std::uint64_t>(tile_size) * 25;
  }

  explicit MapTile(std::int64_t tile_size) : tile_size_(tile_size) {}

  /// Starts over, uncovered. `rect` is the part of the tile that lies in the level.
  void reset(const TexelRect& rect) {
    rect_ = rect;
    const auto texels = static_cast<std::size_t>(tile_size_ * tile_size_);
    count_.assign(texels, 0);
    chart_.assign(texels, 0);
    face_.assign(texels, 0);
    scaling_.assign(texels, 0);
    distortion_.assign(texels, 0);
    sign_.assign(texels, 0);
    several_charts_.assign(texels, 0);
  }

  void draw(const SnappedTriangle& triangle, const FaceLook& look) {
    RowSpans(rect_).visit(triangle, [&](std::int64_t y, std::int64_t x0, std::int64_t x1) {
      const std::size_t row = static_cast<std::size_t>((rect_.y1 - 1 - y) * tile_size_);
      for (std::int64_t x = x0; x < x1; ++x) {
        cover(row + static_cast<std::size_t>(x - rect_.x0), triangle.chart + 1, look);
      }
    });
  }

  const TexelRect& rect() const { return rect_; }
  std::int64_t tile_size() const { return tile_size_; }
  /// Floats, which every viewer shows, and which are exact to 2^24.
  const std::vector<float>& count() const { return count_; }
  const std::vector<std::uint32_t>& chart() const { return chart_; }  ///< plus one; 0: none
  const std::vector<float>& scaling() const { return scaling_; }
  const std::vector<float>& distortion() const { return distortion_; }
  const std::vector<float>& sign() const { return sign_; }
  bool has_several_charts(std::size_t at) const { return several_charts_[at] != 0; }

 private:
  void cover(std::size_t at, std::uint32_t chart, const FaceLook& look) {
    if (chart_[at] != 0 && chart_[at] != chart) several_charts_[at] = 1;
    count_[at] += 1;
    if (std::pair(chart_[at], face_[at]) > std::pair(chart, look.face)) return;
    chart_[at] = chart;
    face_[at] = look.face;
    scaling_[at] = look.scaling;
    distortion_[at] = look.distortion;
    sign_[at] = look.sign;
  }

  std::int64_t tile_size_;
  TexelRect rect_;
  std::vector<std::uint32_t> chart_, face_;
  std::vector<float> count_, scaling_, distortion_, sign_;
  std::vector<std::uint8_t> several_charts_;
};

}  // namespace atlasgauge
