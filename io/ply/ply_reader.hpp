#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "io/file/byte_source.hpp"
#include "io/file/file_listener.hpp"
#include "io/model/part_reader.hpp"

namespace atlasgauge {

/// Reads a PLY file (ascii or binary, plain or compressed) as one part, in constant memory.
///
/// Positions are x, y, z of the element vertex; texture coordinates those of face corners (list
/// texcoord), else of vertices (s and t, u and v, or texture_u and texture_v). Text is rounded to
/// the type that the header declares. Faces are polygons of `face` and strips of `tristrips`.
/// The images are those of `comment TextureFile`, chosen by `texnumber`, else the first; without
/// any, that beside the file that shares its name. All else is skipped.
class PlyReader : public PartReader {
 public:
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

  /// `block_bytes` are read at a time (at least 64).
  explicit PlyReader(std::string path, std::size_t block_bytes = kBlockBytes,
                     FileListener files = {});
  /// From a source under a name.
  PlyReader(std::unique_ptr<ByteSource> source, std::string path,
            std::size_t block_bytes = kBlockBytes);

  std::unique_ptr<MeshPart> next() override;
  const PartMaterials& materials() const override { return materials_; }

 private:
  std::unique_ptr<ByteSource> source_;  // null after the first part
  std::string path_;
  std::size_t block_bytes_;
  FileListener files_;
  PartMaterials materials_;
};

}  // namespace atlasgauge
