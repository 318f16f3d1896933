#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/collect_sink.hpp"

namespace atlasgauge {

// What a reader handed out, in a form that compares.

inline std::vector<std::vector<double>> positions_of(const CollectSink& mesh) {
  std::vector<std::vector<double>> values;
  for (const Position& p : mesh.positions) values.push_back({p.x, p.y, p.z});
  return values;
}

inline std::vector<std::vector<float>> texcoords_of(const CollectSink& mesh) {
  std::vector<std::vector<float>> values;
  for (const TexCoord& t : mesh.texcoords) values.push_back({t.u, t.v});
  return values;
}

/// Corners of the faces.
inline std::vector<std::vector<std::uint32_t>> corners_of(const CollectSink& mesh) {
  std::vector<std::vector<std::uint32_t>> values;
  for (const FaceRecord& f : mesh.faces) values.push_back({raw(f.v[0]), raw(f.v[1]), raw(f.v[2])});
  return values;
}

}  // namespace atlasgauge
