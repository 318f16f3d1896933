#include "io/draco/draco_mesh.hpp"

#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <array>
#include <new>
#include <stdexcept>
#include <utility>

#include "io/draco/allocation_limit.hpp"
#include "io/draco/draco_materials.hpp"
#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// Most bytes that a decoder holds of one value of an attribute, as integers and as what it is.
std::uint64_t value_bytes(const draco::PointAttribute& attribute) {
  return static_cast<std::uint64_t>(attribute.num_components()) * sizeof(std::int32_t) +
         static_cast<std::uint64_t>(attribute.byte_stride());
}

/// One of Draco's decoders, stopped before it allocates more for attributes than the header's
/// decoding_bytes has room for.
template <class Decoder>
class BoundedDecoder : public Decoder {
 public:
  explicit BoundedDecoder(const DracoHeader& header) : header_(header) {}

  /// Bytes that the attributes would take, if that is too much.
  std::uint64_t refused_bytes() const { return refused_bytes_; }

 protected:
  bool DecodeAllAttributes() override {
    const std::uint64_t bytes = attribute_bytes();
    if (bytes <= header_.attribute_bytes) return Decoder::DecodeAllAttributes();
    refused_bytes_ = bytes;
    return false;
  }

 private:
  std::uint64_t attribute_bytes() const {
    const draco::PointCloud& points = *this->point_cloud();
    std::uint64_t bytes = 0;
    for (std::int32_t i = 0; i < points.num_attributes(); ++i) {
      bytes += values_of(i) * value_bytes(*points.attribute(i));
      bytes += points.num_points() * sizeof(std::uint32_t);
    }
    return bytes;
  }

  std::uint64_t values_of(std::int32_t attribute) const {
    const std::uint64_t points = this->point_cloud()->num_points();
    const draco::CornerTable* const corners = this->GetCornerTable();
    if (corners == nullptr || shares_seams()) return points;
    const draco::MeshAttributeCornerTable* const seamed = this->GetAttributeCornerTable(attribute);
    return static_cast<std::uint64_t>(seamed == nullptr ? corners->num_vertices()
                                                        : seamed->num_vertices());
  }

  /// No encoder writes such a stream, and Draco knows the seams of one of the attributes only.
  bool shares_seams() const {
    return this->num_attributes_decoders() > header_.seamed_attributes + 1;
  }

  const DracoHeader& header_;
  std::uint64_t refused_bytes_ = 0;
};

/// Parameters of an attribute's quantization.
struct Grid {
  std::uint32_t bits = 0;
  double step = 0;
};

Grid grid_of(const draco::PointAttribute* portable) {
  draco::AttributeQuantizationTransform transform;
  const bool is_quantized = portable != nullptr &&
                            portable->GetAttributeTransformData() != nullptr &&
                            transform.InitFromAttribute(*portable);
  if (!is_quantized || transform.quantization_bits() < 1) return {};
  const auto bits = static_cast<std::uint32_t>(transform.quantization_bits());
  const auto steps = static_cast<double>((std::uint64_t{1} << bits) - 1);
  return {bits, static_cast<double>(transform.range()) / steps};
}

/// -1 for none.
std::int32_t find_attribute(const draco::Mesh& mesh, draco::GeometryAttribute::Type kind,
                            std::optional<std::uint32_t> unique_id, bool by_kind) {
  if (unique_id) return mesh.GetAttributeIdByUniqueId(*unique_id);
  return by_kind ? mesh.GetNamedAttributeId(kind) : -1;
}

void check_components(const draco::PointAttribute& attribute, std::int32_t expected,
                      const char* what, const std::string& path) {
  if (attribute.num_components() == expected) return;
  throw Error(ErrorKind::kInput, path, 0,
              fmt::format("found {} of {} components in a Draco stream, expected {}; encode the "
                          "model anew",
                          what, attribute.num_components(), expected));
}

}  // namespace

class DracoMesh::Decoded {
 public:
  Decoded(std::string_view stream, const DracoHeader& header, const DracoAttributes& attributes,
          const std::string& path)
      : path_(path) {
    if (header.is_edgebreaker) {
      decode_with<draco::MeshEdgebreakerDecoder>(stream, header, attributes);
    } else {
      decode_with<draco::MeshSequentialDecoder>(stream, header, attributes);
    }
    find_materials();
    check_indices();
  }

  const draco::Mesh& mesh() const { return mesh_; }
  const draco::PointAttribute& positions() const { return *positions_; }
  const draco::PointAttribute* texcoords() const { return texcoords_; }
  const std::optional<Quantization>& quantization() const { return quantization_; }
  const std::vector<std::string>& material_names() const { return material_names_; }

  MaterialId material_of(draco::PointIndex point) const {
    if (materials_ == nullptr) return kNone<MaterialId>;
    std::uint32_t value = 0;
    const bool is_number = materials_->ConvertValue(materials_->mapped_index(point), 1, &value);
    return is_number && value < material_names_.size() ? MaterialId{value} : kNone<MaterialId>;
  }

 private:
  [[noreturn]] void refuse(const std::string& text) const {
    throw Error(ErrorKind::kInput, path_, 0, text);
  }

  template <class Decoder>
  void decode_with(std::string_view stream, const DracoHeader& header,
                   const DracoAttributes& attributes) {
    BoundedDecoder<Decoder> decoder(header);
    draco::DecoderBuffer buffer;
    buffer.Init(stream.data(), stream.size());
    const draco::Status status = run(decoder, buffer, header);
    if (decoder.refused_bytes() != 0)
      refuse_attributes(decoder.refused_bytes(), header.attribute_bytes);
    if (!status.ok()) {
      refuse(
          fmt::format("found a Draco stream that cannot be decoded ({}); the file is damaged, "
                      "write it anew",
                      status.error_msg_string()));
    }
    choose(attributes, decoder);
  }

  /// Draco believes some numbers of a stream before it sees that they cannot be, such as how many
  /// orientations the prediction of texture coordinates has: up to 256 MiB of them.
  draco::Status run(draco::MeshDecoder& decoder, draco::DecoderBuffer& buffer,
                    const DracoHeader& header) {
    const AllocationLimit limit(header.decoding_bytes);
    try {
      const draco::DecoderOptions options;
      return decoder.Decode(options, &buffer, &mesh_);
    } catch (const std::length_error&) {
      refuse_claims(header);
    } catch (const std::bad_alloc&) {
      if (limit.was_reached()) refuse_claims(header);
      throw;
    }
  }

  [[noreturn]] void refuse_claims(const DracoHeader& header) const {
    refuse(
        fmt::format("found a Draco stream that takes more than {} bytes to decode, and one of "
                    "{} faces and {} points takes less; the file is damaged, write it anew",
                    header.decoding_bytes, header.counts.faces, header.counts.positions));
  }

  [[noreturn]] void refuse_attributes(std::uint64_t bytes, std::uint64_t room) const {
    throw Error(ErrorKind::kResource, path_, 0,
                fmt::format("found {} attributes that take {} bytes to decode for {} points, and "
                            "there is room for {}; encode the model without attributes other than "
                            "positions and texture coordinates",
                            mesh_.num_attributes(), bytes, mesh_.num_points(), room));
  }

  void choose(const DracoAttributes& attributes, draco::MeshDecoder& decoder) {
    const std::int32_t position = find_attribute(mesh_, draco::GeometryAttribute::POSITION,
                                                 attributes.position_id, attributes.by_kind);
    const std::int32_t texcoord = find_attribute(mesh_, draco::GeometryAttribute::TEX_COORD,
                                                 attributes.texcoord_id, attributes.by_kind);
    if (position < 0) refuse("found a Draco stream without positions; encode the model anew");
    if (texcoord < 0 && attributes.texcoord_id) {
      refuse(
          fmt::format("found no attribute {} in a Draco stream, expected texture coordinates; "
                      "encode the model anew",
                      *attributes.texcoord_id));
    }
    positions_ = mesh_.attribute(position);
    check_components(*positions_, 3, "positions", path_);
    const Grid position_grid = grid_of(decoder.GetPortableAttribute(position));
    Grid uv_grid;
    if (texcoord >= 0) {
      texcoords_ = mesh_.attribute(texcoord);
      check_components(*texcoords_, 2, "texture coordinates", path_);
      uv_grid = grid_of(decoder.GetPortableAttribute(texcoord));
    }
    if (position_grid.bits == 0 && uv_grid.bits == 0) return;
    quantization_ =
        Quantization{position_grid.bits, position_grid.step, uv_grid.bits, uv_grid.step};
  }

  void find_materials() {
    if (mesh_.GetMetadata() == nullptr) return;
    std::optional<DracoMaterials> found = find_draco_materials(*mesh_.GetMetadata());
    if (!found) return;
    material_names_ = std::move(found->names);
    const std::int32_t id = mesh_.GetAttributeIdByUniqueId(found->attribute_id);
    if (id < 0 || mesh_.attribute(id)->num_components() != 1) return;
    if (draco::IsDataTypeIntegral(mesh_.attribute(id)->data_type())) {
      materials_ = mesh_.attribute(id);
    }
  }

  /// So that whatever the stream holds, nothing reads beside the values.
  void check_indices() const {
    for (std::uint32_t i = 0; i < mesh_.num_points(); ++i) {
      const draco::PointIndex point(i);
      for (const draco::PointAttribute* attribute : {positions_, texcoords_, materials_}) {
        if (attribute == nullptr) continue;
        if (attribute->mapped_index(point).value() < attribute->size()) continue;
        refuse(
            fmt::format("found point {} of a Draco stream without a value; the file is damaged, "
                        "write it anew",
                        i));
      }
    }
    for (std::uint32_t i = 0; i < mesh_.num_faces(); ++i) {
      for (const draco::PointIndex& point : mesh_.face(draco::FaceIndex(i))) {
        if (point.value() < mesh_.num_points()) continue;
        refuse(
            fmt::format("found face {} of a Draco stream at point {} of {}; the file is "
                        "damaged, write it anew",
                        i, point.value(), mesh_.num_points()));
      }
    }
  }

  std::string path_;
  draco::Mesh mesh_;
  const draco::PointAttribute* positions_ = nullptr;
  const draco::PointAttribute* texcoords_ = nullptr;
  const draco::PointAttribute* materials_ = nullptr;
  std::optional<Quantization> quantization_;
  std::vector<std::string> material_names_;
};

DracoMesh::DracoMesh(std::unique_ptr<Decoded> decoded) : decoded_(std::move(decoded)) {}
DracoMesh::DracoMesh(DracoMesh&&) noexcept = default;
DracoMesh& DracoMesh::operator=(DracoMesh&&) noexcept = default;
DracoMesh::~DracoMesh() = default;

DracoMesh DracoMesh::decode(std::string_view stream, const DracoAttributes& attributes,
                            const std::string& path) {
  const DracoHeader header = read_draco_header(stream, stream.size(), path);
  require_draco_mesh(header, path);
  return DracoMesh(std::make_unique<Decoded>(stream, header, attributes, path));
}

std::uint64_t DracoMesh::positions() const {
  return decoded_->positions().size();
}

std::uint64_t DracoMesh::texcoords() const {
  return decoded_->texcoords() == nullptr ? 0 : decoded_->texcoords()->size();
}

std::uint64_t DracoMesh::faces() const {
  return decoded_->mesh().num_faces();
}

Position DracoMesh::position(std::uint64_t i) const {
  std::array<double, 3> values{};
  const draco::AttributeValueIndex index(static_cast<std::uint32_t>(i));
  decoded_->positions().ConvertValue<double, 3>(index, values.data());
  return {values[0] + 0.0, values[1] + 0.0, values[2] + 0.0};
}

TexCoord DracoMesh::texcoord(std::uint64_t i) const {
  std::array<float, 2> values{};
  const draco::AttributeValueIndex index(static_cast<std::uint32_t>(i));
  decoded_->texcoords()->ConvertValue<float, 2>(index, values.data());
  return {values[0] + 0.0F, values[1] + 0.0F};
}

FaceRecord DracoMesh::face(std::uint64_t i) const {
  const draco::Mesh::Face& points =
      decoded_->mesh().face(draco::FaceIndex(static_cast<std::uint32_t>(i)));
  const draco::PointAttribute* const texcoords = decoded_->texcoords();
  FaceRecord face{{}, {}, decoded_->material_of(points[0])};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const draco::PointIndex point = points[corner];
    face.v[corner] = VertexId{decoded_->positions().mapped_index(point).value()};
    face.t[corner] = texcoords == nullptr ? kNone<TexCoordId>
                                          : TexCoordId{texcoords->mapped_index(point).value()};
  }
  return face;
}

std::optional<Quantization> DracoMesh::quantization() const {
  return decoded_->quantization();
}

std::vector<std::string> DracoMesh::material_names() const {
  return decoded_->material_names();
}

}  // namespace atlasgauge
