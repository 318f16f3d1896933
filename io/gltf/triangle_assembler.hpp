#pragma once

#include <array>
#include <cstdint>

#include "io/gltf/gltf_model.hpp"

namespace atlasgauge {

/// Makes triangles of the indices of a primitive, one after the other (glTF 2.0, section 3.7.2.1):
/// every second triangle of a strip is turned, so that all run the same way round.
class TriangleAssembler {
 public:
  /// `is_mirrored`: the placement mirrors, so that corners are taken the other way round.
  TriangleAssembler(GltfMode mode, bool is_mirrored) : mode_(mode), is_mirrored_(is_mirrored) {}

  /// Whether this index completes a triangle.
  bool feed(std::uint32_t index);

  /// The triangle completed last.
  const std::array<std::uint32_t, 3>& corners() const { return corners_; }

  /// Whether the indices so far end within a triangle.
  bool has_rest() const;

  /// Triangles that so many indices make.
  static std::uint64_t triangles(GltfMode mode, std::uint64_t indices);

 private:
  void take(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  GltfMode mode_;
  bool is_mirrored_;
  std::uint64_t fed_ = 0;
  std::array<std::uint32_t, 2> kept_{};
  std::array<std::uint32_t, 3> corners_{};
};

}  // namespace atlasgauge
