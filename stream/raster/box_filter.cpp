#include "stream/raster/box_filter.hpp"

#include <algorithm>
#include <limits>

namespace atlasgauge {
namespace {

/// Half to even. For |x| < 2^51: at 1.5 * 2^52 doubles are the integers.
double rounded(double x) {
  constexpr double kIntegers = 0x1.8p52;
  return x + kIntegers - kIntegers;
}

/// first_centre(snap(texels)), in doubles: a snapped coordinate minus a half never lies midway
/// between multiples of 256.
double first_centre_from(double texels) {
  return rounded(rounded(texels * 256) * (1.0 / 256) - 0.5 / 256);
}

// By value, which std::min and std::max are not: so loops become vector instructions.
double lower(double a, double b) {
  return a < b ? a : b;
}
double higher(double a, double b) {
  return a > b ? a : b;
}

/// The columns or the rows of a tile, of which boxes have centres.
struct Axis {
  double size;        ///< of the level, in texels
  double first, end;  ///< of the tile, with its halo

  /// Positive if there are any between these coordinates, in textures.
  double common(double low, double high) const {
    return lower(first_centre_from(high * size), end) -
           higher(first_centre_from(low * size), first);
  }
};

Axis columns_of(const LevelTile& tile) {
  const TexelRect& window = tile.tile.window();
  return {static_cast<double>(tile.size.width), static_cast<double>(window.x0),
          static_cast<double>(window.x1)};
}

Axis rows_of(const LevelTile& tile) {
  const TexelRect& window = tile.tile.window();
  return {static_cast<double>(tile.size.height), static_cast<double>(window.y0),
          static_cast<double>(window.y1)};
}

}  // namespace

BoxFilter::BoxFilter(std::size_t most)
    : low_u_(most), high_u_(most), low_v_(most), high_v_(most), common_(most), chosen_(most) {}

void BoxFilter::clear() {
  count_ = 0;
  all_low_u_ = all_low_v_ = std::numeric_limits<double>::infinity();
  all_high_u_ = all_high_v_ = -std::numeric_limits<double>::infinity();
}

void BoxFilter::add(const TexCoord (&uv)[3], const SlotFrame& frame) {
  const std::size_t i = count_++;
  low_u_[i] = static_cast<double>(std::min({uv[0].u, uv[1].u, uv[2].u})) + frame.shift_u;
  high_u_[i] = static_cast<double>(std::max({uv[0].u, uv[1].u, uv[2].u})) + frame.shift_u;
  low_v_[i] = static_cast<double>(std::min({uv[0].v, uv[1].v, uv[2].v})) + frame.shift_v;
  high_v_[i] = static_cast<double>(std::max({uv[0].v, uv[1].v, uv[2].v})) + frame.shift_v;
  all_low_u_ = lower(all_low_u_, low_u_[i]);
  all_high_u_ = higher(all_high_u_, high_u_[i]);
  all_low_v_ = lower(all_low_v_, low_v_[i]);
  all_high_v_ = higher(all_high_v_, high_v_[i]);
}

std::span<const std::uint32_t> BoxFilter::choose(const LevelTile& tile) {
  const Axis columns = columns_of(tile), rows = rows_of(tile);
  if (columns.common(all_low_u_, all_high_u_) <= 0) return {};
  if (rows.common(all_low_v_, all_high_v_) <= 0) return {};
  const double *low_u = low_u_.data(), *high_u = high_u_.data();
  const double *low_v = low_v_.data(), *high_v = high_v_.data();
  double* const common = common_.data();
  for (std::size_t i = 0; i < count_; ++i) {
    common[i] = lower(columns.common(low_u[i], high_u[i]), rows.common(low_v[i], high_v[i]));
  }
  std::size_t chosen = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    chosen_[chosen] = i;
    chosen += common[i] > 0 ? 1 : 0;
  }
  return {chosen_.data(), chosen};
}

}  // namespace atlasgauge
