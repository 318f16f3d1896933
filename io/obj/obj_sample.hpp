#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/mesh_batch.hpp"

namespace atlasgauge {

/// Values of a part of the text that stands for `weight` times as much of it. Negative indices
/// count back from a place of their own, far from those of positive ones.
using OnObjSample = std::function<void(double weight, const MeshBatch&)>;

/// How much text a sample takes.
struct ObjSampleSize {
  std::uint64_t most_bytes = std::uint64_t{64} << 20;
  std::size_t part_bytes = std::size_t{256} << 10;
};

/// What the sampling of a model comes to.
struct ObjSampling {
  enum class Coverage {
    kWhole,     ///< all of the text was seen
    kSpread,    ///< parts all over the text: counts by weight are close
    kBeginning  ///< a compressed model's first part, with weights of 1: the rest may be different
  };

  Coverage coverage = Coverage::kWhole;
  double text_bytes = 0;                  ///< of the whole model; a guess for kBeginning
  double sampled_bytes = 0;               ///< of text that was looked at
  std::vector<std::string> mtllib_lines;  ///< the first few, as written after the keyword
};

/// Looks at no more than `size.most_bytes` of an OBJ's text: at all of it, at parts at equal
/// distances, or, where it is compressed, at its beginning. What cannot be read is passed over: the
/// run itself will say so. Throws Error(kInput) for a file that cannot be opened, and for a pipe,
/// which could not be read a second time.
ObjSampling sample_obj(const std::string& path, const OnObjSample& on_sample,
                       const ObjSampleSize& size = {});

}  // namespace atlasgauge
