#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_batch.hpp"
#include "io/model/mesh_part.hpp"

namespace atlasgauge {

/// What can be known of a Draco stream without decoding it.
struct DracoHeader {
  bool is_mesh = false;  ///< else a point cloud
  bool is_edgebreaker = false;
  bool has_metadata = false;
  std::uint8_t major_version = 0, minor_version = 0;
  /// As the stream promises them. Texture coordinates are not counted there: as many as positions
  /// is a guess. A point cloud has positions only.
  PartCounts counts;
  /// Peak of decoding a mesh, as measured (see draco_need.hpp), the stream itself not included.
  /// decode() refuses a stream whose attributes take more.
  std::uint64_t decoding_bytes = 0;
  std::uint64_t attribute_bytes = 0;   ///< of these, room for the values of attributes
  std::uint8_t seamed_attributes = 0;  ///< attributes with a connectivity of their own
  /// Not 0: metadata stand before the counts and go on beyond the given bytes. The counts are then
  /// 0 and decoding_bytes a guess; ask again with so many bytes of the stream.
  std::uint64_t begin_bytes_needed = 0;
};

/// From the first bytes of a stream (256 are enough for every version without metadata). `path` is
/// for messages. Throws Error(kInput) for what is no Draco stream, for one cut short, of an unknown
/// version, or with counts that `stream_bytes` cannot hold; Error(kResource) for more than
/// kMaxElements of anything.
DracoHeader read_draco_header(std::string_view begin, std::uint64_t stream_bytes,
                              const std::string& path);

/// Throws Error(kInput) for a point cloud, which has no faces to measure.
void require_draco_mesh(const DracoHeader& header, const std::string& path);

/// As DracoMesh::material_names(), from the bytes that the header was read from.
std::vector<std::string> read_draco_material_names(std::string_view begin,
                                                   const DracoHeader& header);

/// Which attributes of a stream to take: by their unique ids, as KHR_draco_mesh_compression names
/// them, or the first of their kind.
struct DracoAttributes {
  std::optional<std::uint32_t> position_id{};
  std::optional<std::uint32_t> texcoord_id{};
  bool by_kind = true;  ///< for ids that are not given: the first of the kind, else none
};

/// A decoded mesh.
class DracoMesh {
 public:
  /// Decodes all of a stream. Throws Error(kInput), also for a point cloud, and where positions or
  /// texture coordinates have other than 3 and 2 components; Error(kResource) where attributes
  /// beyond the usual would take more than the header's decoding_bytes.
  static DracoMesh decode(std::string_view stream, const DracoAttributes& attributes,
                          const std::string& path);
  DracoMesh(DracoMesh&&) noexcept;
  DracoMesh& operator=(DracoMesh&&) noexcept;
  ~DracoMesh();

  /// Distinct values of the attribute, in the order of the stream; indices of faces are into these.
  std::uint64_t positions() const;
  std::uint64_t texcoords() const;  ///< 0 without any
  std::uint64_t faces() const;

  /// As decoded, dequantized to float by Draco itself.
  Position position(std::uint64_t i) const;
  /// As stored: the caller knows where v = 0 is.
  TexCoord texcoord(std::uint64_t i) const;
  /// Indices of values, by corner; `t` is kNone without texture coordinates. The material is an
  /// index in material_names(), else kNone.
  FaceRecord face(std::uint64_t i) const;

  /// Bits and steps of what the stream quantizes, in the units of the stream.
  std::optional<Quantization> quantization() const;
  /// Of the attribute named "material" that Draco's own OBJ encoder writes, by value; else empty.
  std::vector<std::string> material_names() const;

 private:
  class Decoded;
  explicit DracoMesh(std::unique_ptr<Decoded> decoded);
  std::unique_ptr<Decoded> decoded_;
};

}  // namespace atlasgauge
