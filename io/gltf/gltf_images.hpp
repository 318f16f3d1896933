#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>

#include "io/gltf/gltf_buffers.hpp"
#include "io/gltf/gltf_model.hpp"
#include "io/model/part_reader.hpp"
#include "io/name_room.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Which glTF of an input an image belongs to.
struct GltfOrigin {
  std::string key;    ///< as no other glTF of the input has it
  std::string label;  ///< for names of images: the file's name
  bool is_alone;      ///< an image's name needs no label to tell it from those of other glTF
};

/// The materials and images of all glTF of an input. An image is named after its URI, else by its
/// name if no other of its glTF has it, else "model.glb#image3"; the last two with the glTF's label
/// where there may be several. Names that are taken nevertheless get a number.
class GltfImages {
 public:
  /// `path` is the file that errors blame; `most_data_bytes` is what images in data: URIs may take.
  GltfImages(std::string path, std::uint64_t most_data_bytes);

  /// Adds all materials of a glTF; returns the number of the first. Warns of images that cannot be
  /// read because of what the glTF says. Throws Error(kInput) for indices of what is not there,
  /// before anything is added; Error(kResource) for too many names.
  std::uint32_t add(const GltfModel& model, GltfBuffers& buffers, const GltfOrigin& origin,
                    Warnings& warnings);

  const PartMaterials& materials() const { return materials_; }

 private:
  class Adding;

  std::string path_;
  std::uint64_t data_bytes_left_;
  NameRoom room_;
  PartMaterials materials_;
  std::unordered_map<std::string, std::uint32_t> image_at_;  // by place
  std::set<std::string> names_;
};

}  // namespace atlasgauge
