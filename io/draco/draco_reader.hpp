#pragma once

#include <memory>
#include <string>

#include "io/file/file_listener.hpp"
#include "io/model/part_reader.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Reads a .drc file as one part. A Draco stream cannot be decoded in pieces, so load() takes the
/// file and what decoding takes (MeshPart::memory_bytes).
///
/// Texture coordinates are taken as from an OBJ, v = 0 at the bottom. Where the stream has names of
/// materials and "model.mtl" lies beside "model.drc", images come from there; else an image beside
/// the file that shares its name is that of all faces.
class DracoReader : public PartReader {
 public:
  /// Warns about libraries of materials that cannot be read.
  DracoReader(std::string path, Warnings& warnings, FileListener files = {});

  /// Throws Error(kInput) for a point cloud too, and for a file that is compressed once more.
  std::unique_ptr<MeshPart> next() override;
  const PartMaterials& materials() const override { return materials_; }

 private:
  std::string path_;
  Warnings& warnings_;
  FileListener files_;
  PartMaterials materials_;
  bool is_read_ = false;
};

}  // namespace atlasgauge
