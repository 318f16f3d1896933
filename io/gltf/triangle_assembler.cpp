#include "io/gltf/triangle_assembler.hpp"

namespace atlasgauge {

bool TriangleAssembler::feed(std::uint32_t index) {
  const std::uint64_t place = fed_++;
  const bool is_list = mode_ == GltfMode::kTriangles;
  const std::uint64_t in_triangle = is_list ? place % 3 : place;
  if (in_triangle < 2) {
    kept_[in_triangle] = index;
    return false;
  }
  const bool is_turned = mode_ == GltfMode::kTriangleStrip && place % 2 == 1;
  if (is_turned) {
    take(kept_[0], index, kept_[1]);
  } else {
    take(kept_[0], kept_[1], index);
  }
  if (mode_ == GltfMode::kTriangleStrip) kept_[0] = kept_[1];
  if (!is_list) kept_[1] = index;
  return true;
}

bool TriangleAssembler::has_rest() const {
  if (mode_ == GltfMode::kTriangles) return fed_ % 3 != 0;
  return fed_ == 1 || fed_ == 2;
}

std::uint64_t TriangleAssembler::triangles(GltfMode mode, std::uint64_t indices) {
  if (mode == GltfMode::kTriangles) return indices / 3;
  return indices < 3 ? 0 : indices - 2;
}

void TriangleAssembler::take(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (is_mirrored_) {
    corners_ = {a, c, b};
  } else {
    corners_ = {a, b, c};
  }
}

}  // namespace atlasgauge
