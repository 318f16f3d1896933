#include "bench/draco_cut.hpp"

#include <draco/attributes/geometry_attribute.h>
#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "bench/text_file.hpp"
#include "io/error.hpp"
#include "io/obj/obj_reader.hpp"
#include "io/texture/mtl_reader.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;
using draco::AttributeValueIndex;
using draco::GeometryAttribute;

template <std::size_t N>
using Floats = std::array<float, N>;

/// The cube around all positions.
struct Bounds {
  Floats<3> low{};
  float side = 0;

  explicit Bounds(const std::vector<Floats<3>>& points) {
    Floats<3> high{};
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    for (const Floats<3>& p : points) {
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) side = std::max(side, high[i] - low[i]);
  }
};

/// What the chunks decode to, as an OBJ.
class DecodedObj {
 public:
  DecodedObj(const std::string& stem, const std::string& name) : obj_(stem + ".obj") {
    obj_.put("mtllib " + name + ".mtl\n");
  }

  void add(const draco::Mesh& mesh, std::uint32_t material) {
    const draco::PointAttribute& positions = *mesh.GetNamedAttribute(GeometryAttribute::POSITION);
    const draco::PointAttribute* const texcoords =
        mesh.GetNamedAttribute(GeometryAttribute::TEX_COORD);
    put_values<3>("v", positions);
    if (texcoords != nullptr) put_values<2>("vt", *texcoords);
    obj_.put(fmt::format("usemtl m{}\n", material));
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
      obj_.put('f');
      for (const draco::PointIndex& point : mesh.face(f)) {
        obj_.put(' ');
        obj_.put(positions_ + positions.mapped_index(point).value() + 1);
        if (texcoords == nullptr) continue;
        obj_.put('/');
        obj_.put(texcoords_ + texcoords->mapped_index(point).value() + 1);
      }
      obj_.put('\n');
    }
    positions_ += positions.size();
    if (texcoords != nullptr) texcoords_ += texcoords->size();
  }

  void close() { obj_.close(); }

 private:
  /// A double has the value of the float; a float read as a double would be another number.
  template <std::size_t N>
  void put_values(const char* keyword, const draco::PointAttribute& values) {
    for (AttributeValueIndex i(0); i < static_cast<std::uint32_t>(values.size()); ++i) {
      Floats<N> value{};
      values.GetValue(i, value.data());
      obj_.put(keyword);
      for (const float x : value) obj_.put(fmt::format(" {}", static_cast<double>(x)));
      obj_.put('\n');
    }
  }

  TextFile obj_;
  std::uint64_t positions_ = 0, texcoords_ = 0;
};

class DracoCutter : public MeshSink {
 public:
  DracoCutter(const std::string& obj_path, const DracoCutOptions& options,
              const std::string& directory)
      : options_(options),
        name_(fs::path(obj_path).stem().string()),
        stem_(directory + "/" + name_),
        decoded_(stem_, name_) {}

  void add(const MeshBatch& batch) override {
    for (const Position& p : batch.positions) {
      positions_.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    for (const TexCoord& t : batch.texcoords) texcoords_.push_back({t.u, t.v});
    for (const FaceRecord& face : batch.faces) {
      const bool full = chunk_.size() == options_.chunk_faces;
      if (!chunk_.empty() && (full || chunk_[0].material != face.material)) write_chunk();
      chunk_.push_back(face);
    }
  }

  std::uint64_t finish() {
    if (!chunk_.empty()) write_chunk();
    decoded_.close();
    return chunk_materials_.size();
  }

  /// The material of each chunk.
  const std::vector<MaterialId>& chunk_materials() const { return chunk_materials_; }
  std::string stem_of(std::size_t chunk) const { return fmt::format("{}_{:05}", stem_, chunk); }
  const std::string& stem() const { return stem_; }

 private:
  bool has_texcoords() const { return raw(chunk_[0].t[0]) < texcoords_.size(); }

  std::unique_ptr<draco::Mesh> mesh() const {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(chunk_.size()));
    const int position = builder.AddAttribute(GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int texcoord =
        has_texcoords() ? builder.AddAttribute(GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32)
                        : -1;
    for (std::uint32_t i = 0; i < chunk_.size(); ++i) {
      const FaceRecord& face = chunk_[i];
      const auto p = [&](int k) { return positions_.at(raw(face.v[k])).data(); };
      const auto t = [&](int k) { return texcoords_.at(raw(face.t[k])).data(); };
      builder.SetAttributeValuesForFace(position, draco::FaceIndex(i), p(0), p(1), p(2));
      if (texcoord < 0) continue;
      builder.SetAttributeValuesForFace(texcoord, draco::FaceIndex(i), t(0), t(1), t(2));
    }
    return builder.Finalize();
  }

  draco::Encoder encoder() {
    if (!bounds_) bounds_.emplace(positions_);
    draco::Encoder encoder;
    encoder.SetEncodingMethod(options_.sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                  : draco::MESH_EDGEBREAKER_ENCODING);
    if (options_.own_grids) {
      encoder.SetAttributeQuantization(GeometryAttribute::POSITION, options_.position_bits);
    } else {
      encoder.SetAttributeExplicitQuantization(GeometryAttribute::POSITION, options_.position_bits,
                                               3, bounds_->low.data(), bounds_->side);
    }
    encoder.SetAttributeQuantization(GeometryAttribute::TEX_COORD, options_.uv_bits);
    return encoder;
  }

  void write_chunk() {
    const std::string path = stem_of(chunk_materials_.size()) + ".drc";
    draco::EncoderBuffer stream;
    const std::unique_ptr<draco::Mesh> raw_mesh = mesh();
    const draco::Status status = encoder().EncodeMeshToBuffer(*raw_mesh, &stream);
    if (!status.ok()) throw Error(ErrorKind::kInternal, path, 0, status.error_msg_string());
    std::ofstream file(path, std::ios::binary);
    file.write(stream.data(), static_cast<std::streamsize>(stream.size()));
    file.close();
    if (!file) throw Error(ErrorKind::kResource, path, 0, errno_text());

    draco::DecoderBuffer buffer;
    buffer.Init(stream.data(), stream.size());
    auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) throw Error(ErrorKind::kInternal, path, 0, "it cannot be decoded");
    decoded_.add(*decoded.value(), raw(chunk_[0].material));
    chunk_materials_.push_back(chunk_[0].material);
    chunk_.clear();
  }

  const DracoCutOptions& options_;
  std::string name_, stem_;
  DecodedObj decoded_;
  std::vector<Floats<3>> positions_;
  std::vector<Floats<2>> texcoords_;
  std::optional<Bounds> bounds_;
  std::vector<FaceRecord> chunk_;
  std::vector<MaterialId> chunk_materials_;
};

ObjSummary read_obj(const std::string& path, MeshSink& sink) {
  constexpr std::size_t kBlockBytes = 1 << 20;
  const std::unique_ptr<ByteSource> source = open_byte_source(path);
  Warnings warnings({});
  ObjReader reader(*source, path, warnings, kBlockBytes);
  for (ObjBlock block; reader.next(block);) {
    reader.parse(block);
    reader.commit(block, sink);
  }
  return reader.finish();
}

/// The images of the materials, by MaterialId; a site's are beside its OBJ.
std::vector<std::optional<fs::path>> images_of(const std::string& obj_path,
                                               const ObjSummary& summary) {
  Warnings warnings({});
  const fs::path folder = fs::absolute(obj_path).parent_path();
  std::vector<std::optional<fs::path>> images(summary.material_names.size());
  for (const std::string& library : summary.mtllib_lines) {
    for (const Material& material : read_mtl((folder / library).string(), warnings)) {
      const auto found = std::ranges::find(summary.material_names, material.name);
      if (found == summary.material_names.end() || !material.image) continue;
      images[static_cast<std::size_t>(found - summary.material_names.begin())] =
          folder / *material.image;
    }
  }
  return images;
}

void link_image(const fs::path& image, const std::string& stem) {
  const fs::path link = stem + image.extension().string();
  std::error_code ignored;
  fs::remove(link, ignored);
  fs::create_symlink(image, link);
}

}  // namespace

std::uint64_t cut_into_draco(const std::string& obj_path, const DracoCutOptions& options,
                             const std::string& directory) {
  fs::create_directories(directory);
  DracoCutter cutter(obj_path, options, directory);
  const ObjSummary summary = read_obj(obj_path, cutter);
  const std::uint64_t chunks = cutter.finish();
  const std::vector<std::optional<fs::path>> images = images_of(obj_path, summary);
  TextFile mtl(cutter.stem() + ".mtl");
  for (std::size_t i = 0; i < images.size(); ++i) {
    mtl.put(fmt::format("newmtl m{}\n", i));
    if (images[i]) mtl.put(fmt::format("map_Kd {}\n", images[i]->string()));
  }
  mtl.close();
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    const MaterialId material = cutter.chunk_materials()[chunk];
    if (material == kNone<MaterialId> || !images[raw(material)]) continue;
    link_image(*images[raw(material)], cutter.stem_of(chunk));
  }
  return chunks;
}

}  // namespace atlasgauge
