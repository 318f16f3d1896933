#include "io/draco/draco_reader.hpp"

#include <filesystem>
#include <optional>
#include <unordered_map>
#include <utility>

#include "io/draco/draco_begin.hpp"
#include "io/draco/draco_mesh.hpp"
#include "io/error.hpp"
#include "io/file/byte_range.hpp"
#include "io/file/byte_source.hpp"
#include "io/file/file_path.hpp"
#include "io/model/part_batches.hpp"
#include "io/name_room.hpp"
#include "io/texture/image_files.hpp"
#include "io/texture/mtl_reader.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

/// What the material of a face means.
enum class FaceMaterials { kNone, kOneImage, kByName };

/// A file that holds a stream as it is.
ByteRange stream_in(const std::string& path) {
  const auto source = open_byte_source(path);
  if (source->is_plain() && source->file_bytes() != 0) {
    return {path, 0, source->file_bytes(), nullptr};
  }
  throw Error(ErrorKind::kInput, path, 0,
              "found an empty file, a pipe or a compressed file, expected a Draco stream in a "
              "plain file; unpack it first");
}

/// The whole stream of a file.
class DracoPart : public MeshPart {
 public:
  DracoPart(ByteRange stream, const DracoHeader& header)
      : stream_(std::move(stream)), header_(header) {}

  void set_materials(FaceMaterials materials) { materials_ = materials; }

  PartCounts counts() const override { return header_.counts; }

  std::uint64_t memory_bytes() const override {
    return stream_.size + header_.decoding_bytes + PartBatches::kMemoryBytes;
  }

  void load() override { mesh_ = DracoMesh::decode(read_range(stream_), {}, stream_.path); }

  void emit(MeshSink& sink, Warnings& warnings) override {
    PartBatches batches(stream_.path, sink, warnings);
    for (std::uint64_t i = 0; i < mesh_->positions(); ++i) batches.add(mesh_->position(i), 0);
    for (std::uint64_t i = 0; i < mesh_->texcoords(); ++i) batches.add(mesh_->texcoord(i), 0);
    for (std::uint64_t i = 0; i < mesh_->faces(); ++i) batches.add(with_material(mesh_->face(i)));
    batches.finish();
    quantization_ = mesh_->quantization();
    mesh_.reset();
  }

  std::optional<Quantization> quantization() const override {
    return mesh_ ? mesh_->quantization() : quantization_;
  }

 private:
  FaceRecord with_material(FaceRecord face) const {
    if (materials_ == FaceMaterials::kByName) return face;
    const bool has_image = materials_ == FaceMaterials::kOneImage;
    face.material = has_image ? MaterialId{0} : kNone<MaterialId>;
    return face;
  }

  ByteRange stream_;
  DracoHeader header_;
  FaceMaterials materials_ = FaceMaterials::kNone;
  std::optional<DracoMesh> mesh_;
  std::optional<Quantization> quantization_;
};

/// Images in the order of the library, of which the first material of a name counts.
PartMaterials materials_by_name(const std::vector<std::string>& names, const fs::path& library,
                                Warnings& warnings) {
  PartMaterials materials;
  NameRoom room(library.string());
  std::unordered_map<std::string, std::optional<std::uint32_t>> image_of;
  std::unordered_map<std::string, std::uint32_t> image_at;
  for (const Material& material : read_mtl_if_readable(library.string(), warnings)) {
    const auto [known, is_first] = image_of.try_emplace(material.name);
    if (!is_first) continue;
    room.add(material.name.size());
    if (!material.image) continue;
    const ImagePlace place = find_image({library.parent_path()}, *material.image);
    const auto next = static_cast<std::uint32_t>(materials.images.size());
    const auto [image, is_new] = image_at.try_emplace(place.path, next);
    known->second = image->second;
    if (is_new) {
      room.add(material.image->size() + 2 * place.path.size());
      materials.images.push_back(image_in_file(*material.image, place.path));
    }
  }
  for (const std::string& name : names) {
    const auto found = image_of.find(name);
    materials.image_of_material.push_back(found == image_of.end() ? std::nullopt : found->second);
  }
  return materials;
}

}  // namespace

DracoReader::DracoReader(std::string path, Warnings& warnings, FileListener files)
    : path_(std::move(path)), warnings_(warnings), files_(std::move(files)) {}

std::unique_ptr<MeshPart> DracoReader::next() {
  if (std::exchange(is_read_, true)) return nullptr;
  const ByteRange stream = stream_in(path_);
  const DracoBegin begin = read_draco_begin(stream);
  require_draco_mesh(begin.header, path_);
  const std::vector<std::string> names = read_draco_material_names(begin.bytes, begin.header);
  auto part = std::make_unique<DracoPart>(stream, begin.header);
  const fs::path library = fs::path(path_).replace_extension(".mtl");
  if (!names.empty()) files_.tell(library.string());
  if (!names.empty() && is_file(library)) {
    materials_ = materials_by_name(names, library, warnings_);
    part->set_materials(FaceMaterials::kByName);
    return part;
  }
  for (const std::string& place : places_of_stem_image(path_)) files_.tell(place);
  if (std::optional<NamedImage> image = image_of_stem(path_)) {
    materials_ = {{std::move(*image)}, {0}};
    part->set_materials(FaceMaterials::kOneImage);
  }
  return part;
}

}  // namespace atlasgauge
