#include "io/ply/ply_body.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <utility>

#include "io/model/part_batches.hpp"
#include "io/ply/ply_cursor.hpp"
#include "io/ply/ply_faces.hpp"

namespace atlasgauge {
namespace {

/// Reads the body of a file by one of the cursors.
template <class Cursor>
class BodyReader {
 public:
  BodyReader(PlyInput& input, const PlyHeader& header, const PlyLayout& layout,
             const std::string& path, MeshSink& sink, Warnings& warnings)
      : header_(header),
        layout_(layout),
        warnings_(warnings),
        place_{path},
        cursor_(input, place_),
        batches_(path, sink, warnings),
        faces_(cursor_, place_, layout, batches_) {}

  void read() {
    for (const PlyElement& element : header_.elements) read_element(element);
    batches_.finish();
    if (faces_.wrong_texcoords() != 0) warn_about_texcoords();
    if (long_lines_ > Warnings::kShownPerKind) {
      warnings_.count(kLongLineKind, long_lines_ - Warnings::kShownPerKind);
    }
    if (!cursor_.at_end()) warn_about_rest();
  }

 private:
  void read_element(const PlyElement& element) {
    place_.element = &element;
    if (element.name == "vertex") {
      read_records([&] { read_vertex(element); });
    } else if (element.name == "face") {
      read_records([&] { faces_.read_record(); });
    } else if (element.name == "tristrips" && layout_.strip_indices) {
      read_records([&] { read_strip(element); });
    } else {
      read_records([&] { skip_record(element); });
    }
  }

  /// A record without properties has no bytes: there is nothing to read, however many there are.
  template <class Read>
  void read_records(Read read) {
    const PlyElement& element = *place_.element;
    if (element.properties.empty()) return;
    for (place_.record = 0; place_.record < element.count; ++place_.record) {
      read();
      if (!cursor_.end_record()) [[unlikely]] {
        warn_about_rest_of_line();
      }
    }
  }

  /// Some exporters write more than their header says.
  void warn_about_rest_of_line() {
    ++long_lines_;
    if (long_lines_ > Warnings::kShownPerKind) return;
    warnings_.add(kLongLineKind, place_.path, cursor_.line(),
                  fmt::format("the line of {} has more than the header promises: it is skipped",
                              place_.element->name));
  }

  void skip_record(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) skip(property);
  }

  void skip(const PlyProperty& property) {
    const std::uint64_t values = property.is_list() ? cursor_.length(*property.count_type) : 1;
    cursor_.skip(property.type, values);
  }

  void read_vertex(const PlyElement& vertex) {
    std::array<double, 3> xyz{};
    std::array<float, 2> uv{};
    for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
      const PlyProperty& property = vertex.properties[i];
      const PlyLayout::Role role = layout_.vertex_roles[i];
      if (role == PlyLayout::kNoRole) {
        skip(property);
      } else if (role <= PlyLayout::kZ) {
        xyz[role] = cursor_.real(property.type);
      } else {
        uv[static_cast<std::size_t>(role - PlyLayout::kU)] = cursor_.real32(property.type);
      }
    }
    batches_.add(Position{xyz[0], xyz[1], xyz[2]}, cursor_.line());
    if (layout_.vertices_have_uv) batches_.add(TexCoord{uv[0], uv[1]}, cursor_.line());
  }

  void read_strip(const PlyElement& strips) {
    for (std::size_t i = 0; i < strips.properties.size(); ++i) {
      const PlyProperty& property = strips.properties[i];
      if (i == layout_.strip_indices) {
        read_strip_indices(property);
      } else {
        skip(property);
      }
    }
  }

  /// Several strips may share a list, with -1 between them. Every second triangle of a strip runs
  /// the other way round.
  void read_strip_indices(const PlyProperty& property) {
    const std::uint64_t length = cursor_.length(*property.count_type);
    std::array<VertexId, 2> before{};
    std::uint64_t corners = 0;  // of the strip so far
    for (std::uint64_t i = 0; i < length; ++i) {
      const std::int64_t index = cursor_.integer(property.type);
      if (!exists(index)) {
        if (index != -1) batches_.drop_polygon(kNoSuchVertex, cursor_.line());
        corners = 0;
        continue;
      }
      const VertexId v{static_cast<std::uint32_t>(index)};
      if (corners >= 2) add_of_strip(before, v, corners % 2 == 1);
      before = {before[1], v};
      ++corners;
    }
  }

  bool exists(std::int64_t index) const {
    return index >= 0 && static_cast<std::uint64_t>(index) < layout_.vertices;
  }

  void add_of_strip(std::array<VertexId, 2> before, VertexId v, bool is_turned) {
    if (is_turned) std::swap(before[0], before[1]);
    const auto texcoord = [&](VertexId id) {
      return layout_.vertices_have_uv ? TexCoordId{raw(id)} : kNone<TexCoordId>;
    };
    const bool has_image = layout_.textures != 0 || layout_.has_own_image;
    batches_.add(FaceRecord{{before[0], before[1], v},
                            {texcoord(before[0]), texcoord(before[1]), texcoord(v)},
                            has_image ? MaterialId{0} : kNone<MaterialId>});
  }

  void warn_about_texcoords() {
    constexpr const char* kKind = "texture coordinates incomplete";
    warnings_.add(kKind, place_.path, 0,
                  fmt::format("the list texcoord of {} polygons does not have two values a corner: "
                              "taken as none",
                              faces_.wrong_texcoords()));
    warnings_.count(kKind, faces_.wrong_texcoords() - 1);
  }

  void warn_about_rest() {
    warnings_.add("data left over", place_.path, cursor_.line(),
                  "there is more than the header promises: it is skipped");
  }

  static constexpr const char* kLongLineKind = "line left over";
  static constexpr const char* kNoSuchVertex = "it names a vertex that does not exist";

  const PlyHeader& header_;
  const PlyLayout& layout_;
  Warnings& warnings_;
  PlyPlace place_;
  Cursor cursor_;
  PartBatches batches_;
  PlyFaces<Cursor> faces_;
  std::uint64_t long_lines_ = 0;
};

}  // namespace

std::size_t ply_body_bytes() {
  return PartBatches::kMemoryBytes + PlyFaces<PlyTextCursor>::kMemoryBytes;
}

void read_ply_body(PlyInput& input, const PlyHeader& header, const PlyLayout& layout,
                   const std::string& path, MeshSink& sink, Warnings& warnings) {
  const auto read_by = [&]<class Cursor>() {
    BodyReader<Cursor>(input, header, layout, path, sink, warnings).read();
  };
  switch (header.format) {
    case PlyFormat::kAscii:
      return read_by.template operator()<PlyTextCursor>();
    case PlyFormat::kLittleEndian:
      return read_by.template operator()<PlyBinaryCursor<std::endian::little>>();
    case PlyFormat::kBigEndian:
      return read_by.template operator()<PlyBinaryCursor<std::endian::big>>();
  }
}

}  // namespace atlasgauge
