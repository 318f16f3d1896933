#include "io/draco/draco_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "io/bytes.hpp"
#include "io/draco/draco_mesh.hpp"
#include "io/error.hpp"
#include "io/file/byte_source.hpp"
#include "io/model/part_batches.hpp"
#include "io/name_room.hpp"
#include "io/texture/image_files.hpp"
#include "io/texture/mtl_reader.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

/// What the material of a face means.
enum class FaceMaterials { kNone, kOneImage, kByName };

/// Size of a file that holds a stream as it is.
std::uint64_t stream_bytes_of(const std::string& path) {
  const auto source = open_byte_source(path);
  if (source->is_plain() && source->file_bytes() != 0) return source->file_bytes();
  throw Error(ErrorKind::kInput, path, 0,
              "found an empty file, a pipe or a compressed file, expected a Draco stream in a "
              "plain file; unpack it first");
}

std::string read_begin(const std::string& path, std::uint64_t bytes) {
  std::string begin(bytes, '\0');
  begin.resize(read_file_at(path, 0, begin.data(), begin.size()));
  return begin;
}

/// The whole stream of a file.
class DracoPart : public MeshPart {
 public:
  explicit DracoPart(std::string path) : path_(std::move(path)) {
    stream_bytes_ = stream_bytes_of(path_);
    constexpr std::uint64_t kUsualBytes = 256;
    begin_ = read_begin(path_, std::min(kUsualBytes, stream_bytes_));
    header_ = read_draco_header(begin_, stream_bytes_, path_);
    while (header_.begin_bytes_needed != 0) {
      check_metadata(header_.begin_bytes_needed);
      begin_ = read_begin(path_, header_.begin_bytes_needed);
      header_ = read_draco_header(begin_, stream_bytes_, path_);
    }
    require_draco_mesh(header_, path_);
  }

  std::vector<std::string> take_material_names() {
    std::vector<std::string> names = read_draco_material_names(begin_, header_);
    begin_ = {};
    return names;
  }

  void set_materials(FaceMaterials materials) { materials_ = materials; }

  PartCounts counts() const override { return header_.counts; }

  std::uint64_t memory_bytes() const override {
    return stream_bytes_ + header_.decoding_bytes + PartBatches::kMemoryBytes;
  }

  void load() override {
    const std::string stream = read_begin(path_, stream_bytes_);
    mesh_ = DracoMesh::decode(stream, {}, path_);
  }

  void emit(MeshSink& sink, Warnings& warnings) override {
    PartBatches batches(path_, sink, warnings);
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
  void check_metadata(std::uint64_t bytes) const {
    constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 20;
    if (std::min(stream_bytes_, kMostBytes) >= bytes) return;
    throw Error(ErrorKind::kResource, path_, 0,
                fmt::format("found more than {} of Draco metadata before the mesh; encode the "
                            "model without them",
                            format_bytes(kMostBytes)));
  }

  FaceRecord with_material(FaceRecord face) const {
    if (materials_ == FaceMaterials::kByName) return face;
    const bool has_image = materials_ == FaceMaterials::kOneImage;
    face.material = has_image ? MaterialId{0} : kNone<MaterialId>;
    return face;
  }

  std::string path_;
  std::uint64_t stream_bytes_ = 0;
  std::string begin_;
  DracoHeader header_;
  FaceMaterials materials_ = FaceMaterials::kNone;
  std::optional<DracoMesh> mesh_;
  std::optional<Quantization> quantization_;
};

std::vector<Material> read_library(const std::string& path, Warnings& warnings) {
  try {
    return read_mtl(path, warnings);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    warnings.add("library unreadable", path, 0, error.what());
    return {};
  }
}

/// Images in the order of the library, of which the first material of a name counts.
PartMaterials materials_by_name(const std::vector<std::string>& names, const fs::path& library,
                                Warnings& warnings) {
  PartMaterials materials;
  NameRoom room(library.string());
  std::unordered_map<std::string, std::optional<std::uint32_t>> image_of;
  std::unordered_map<std::string, std::uint32_t> image_at;
  for (const Material& material : read_library(library.string(), warnings)) {
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

DracoReader::DracoReader(std::string path, Warnings& warnings)
    : path_(std::move(path)), warnings_(warnings) {}

std::unique_ptr<MeshPart> DracoReader::next() {
  if (std::exchange(is_read_, true)) return nullptr;
  auto part = std::make_unique<DracoPart>(path_);
  const std::vector<std::string> names = part->take_material_names();
  const fs::path library = fs::path(path_).replace_extension(".mtl");
  if (!names.empty() && is_file(library)) {
    materials_ = materials_by_name(names, library, warnings_);
    part->set_materials(FaceMaterials::kByName);
  } else if (std::optional<NamedImage> image = image_of_stem(path_)) {
    materials_ = {{std::move(*image)}, {0}};
    part->set_materials(FaceMaterials::kOneImage);
  }
  return part;
}

}  // namespace atlasgauge
