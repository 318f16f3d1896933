#include "io/ply/ply_reader.hpp"

#include <filesystem>
#include <optional>
#include <unordered_map>
#include <utility>

#include "io/ply/ply_body.hpp"
#include "io/ply/ply_header.hpp"
#include "io/ply/ply_input.hpp"
#include "io/ply/ply_layout.hpp"
#include "io/texture/image_files.hpp"

namespace atlasgauge {
namespace {

/// All of a file.
class PlyPart : public MeshPart {
 public:
  PlyPart(std::unique_ptr<ByteSource> source, std::string path, std::size_t block_bytes)
      : source_(std::move(source)),
        path_(std::move(path)),
        block_bytes_(block_bytes),
        input_(*source_, block_bytes),
        header_(read_ply_header(input_, path_)),
        layout_(lay_out_ply(header_, path_)) {}

  const PlyHeader& header() const { return header_; }
  void set_own_image() { layout_.has_own_image = true; }

  PartCounts counts() const override {
    const std::uint64_t guess = layout_.face_texcoord ? 3 * layout_.polygons : 0;
    return {layout_.vertices, layout_.vertices_have_uv ? layout_.vertices : guess,
            layout_.polygons};
  }

  std::uint64_t memory_bytes() const override {
    return PlyInput::memory_bytes(block_bytes_) + ply_body_bytes();
  }

  void emit(MeshSink& sink, Warnings& warnings) override {
    read_ply_body(input_, header_, layout_, path_, sink, warnings);
  }

 private:
  std::unique_ptr<ByteSource> source_;
  std::string path_;
  std::size_t block_bytes_;
  PlyInput input_;
  PlyHeader header_;
  PlyLayout layout_;
};

/// Material i is that of texture i of the header.
PartMaterials materials_of(const PlyHeader& header, const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  PartMaterials materials;
  std::unordered_map<std::string, std::uint32_t> image_at;
  for (const std::string& name : header.texture_files) {
    const ImagePlace place = find_image({folder}, name);
    const auto next = static_cast<std::uint32_t>(materials.images.size());
    const auto [known, is_new] = image_at.try_emplace(place.path, next);
    if (is_new) materials.images.push_back(image_in_file(name, place.path));
    materials.image_of_material.emplace_back(known->second);
  }
  return materials;
}

}  // namespace

PlyReader::PlyReader(std::string path, std::size_t block_bytes, FileListener files)
    : source_(open_byte_source(path)),
      path_(std::move(path)),
      block_bytes_(block_bytes),
      files_(std::move(files)) {}

PlyReader::PlyReader(std::unique_ptr<ByteSource> source, std::string path, std::size_t block_bytes)
    : source_(std::move(source)), path_(std::move(path)), block_bytes_(block_bytes) {}

std::unique_ptr<MeshPart> PlyReader::next() {
  if (source_ == nullptr) return nullptr;
  auto part = std::make_unique<PlyPart>(std::move(source_), path_, block_bytes_);
  materials_ = materials_of(part->header(), path_);
  if (!materials_.images.empty()) return part;
  for (const std::string& place : places_of_stem_image(path_)) files_.tell(place);
  if (std::optional<NamedImage> image = image_of_stem(path_)) {
    materials_ = {{std::move(*image)}, {0}};
    part->set_own_image();
  }
  return part;
}

}  // namespace atlasgauge
