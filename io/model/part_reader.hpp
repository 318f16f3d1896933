#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "io/model/image_source.hpp"
#include "io/model/mesh_part.hpp"

namespace atlasgauge {

/// The materials of a model, by MaterialId: the image that gives a material its colour, or none. An
/// image is listed once however many materials use it.
struct PartMaterials {
  std::vector<NamedImage> images;
  std::vector<std::optional<std::uint32_t>> image_of_material;  ///< index in `images`
};

/// Hands out the parts of one input, in an order that does not change between runs. Opens files as
/// it goes, so that thousands of tiles are never open or known at once.
class PartReader {
 public:
  virtual ~PartReader() = default;
  /// The next part, or null after the last. Throws Error(kInput).
  virtual std::unique_ptr<MeshPart> next() = 0;
  /// Of all parts so far.
  virtual const PartMaterials& materials() const = 0;
};

}  // namespace atlasgauge
