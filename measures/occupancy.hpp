#pragma once

#include <cstdint>
#include <limits>

#include "stream/groups.hpp"

namespace atlasgauge {

/// How much of the textures the atlas uses.
class Occupancy {
 public:
  void add(const TextureLevel& level) {
    if (level.level != 0) return;
    const std::uint64_t texels = level.width * level.height;
    texels_ += texels;
    if (level.counts.covered == 0) return;
    used_ += texels;
    covered_ += level.counts.covered;
  }
  void merge(const Occupancy& other) {
    texels_ += other.texels_;
    used_ += other.used_;
    covered_ += other.covered_;
  }

  /// Covered texels over all texels of the slots that have a covered texel; NaN without any.
  double value() const {
    if (used_ == 0) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(covered_) / static_cast<double>(used_);
  }
  /// Of all slots, covered or not.
  std::uint64_t texels() const { return texels_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(texels_, used_, covered_);
  }

 private:
  std::uint64_t texels_ = 0, used_ = 0, covered_ = 0;
};

}  // namespace atlasgauge
