#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/model/part_reader.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/collect_sink.hpp"

namespace atlasgauge::fuzz {

/// More than so many values are not read: a few bytes can promise millions.
inline constexpr std::uint64_t kMostValues = 20000;

/// What a reader said: values, or the text of an error.
struct PartsReading {
  std::string values;
  std::string error;
};

template <class T>
std::string bits(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

inline void check_part(const CollectSink& mesh, const PartCounts& promised,
                       const PartMaterials& materials) {
  require(mesh.positions.size() <= promised.positions, "no more positions than promised");
  require(mesh.faces.size() <= promised.faces, "no more faces than promised");
  for (const FaceRecord& face : mesh.faces) {
    for (int corner = 0; corner < 3; ++corner) {
      require(raw(face.v[corner]) < mesh.positions.size(), "corners name positions");
      require(face.t[corner] == kNone<TexCoordId> || raw(face.t[corner]) < mesh.texcoords.size(),
              "corners name texture coordinates, or none");
    }
    require(face.material == kNone<MaterialId> ||
                raw(face.material) < materials.image_of_material.size(),
            "faces name materials, or none");
  }
  for (const auto& image : materials.image_of_material) {
    require(!image || *image < materials.images.size(), "materials name images, or none");
  }
}

template <class MakeReader>
std::string read_values(const MakeReader& make_reader) {
  Warnings warnings(nullptr);
  auto reader = make_reader(warnings);
  std::string values;
  while (const std::unique_ptr<MeshPart> part = reader.next()) {
    const PartCounts promised = part->counts();
    if (promised.positions + promised.faces + values.size() / 8 > kMostValues) break;
    CollectSink mesh;
    part->load();
    part->emit(mesh, warnings);
    check_part(mesh, promised, reader.materials());
    values += bits(mesh.positions) + bits(mesh.texcoords) + bits(mesh.faces);
  }
  return values;
}

/// Any input gives values, or an error that names its file.
template <class MakeReader>
PartsReading read_parts_of(const MakeReader& make_reader, const std::string& folder) {
  try {
    return {read_values(make_reader), {}};
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::kInput || error.kind() == ErrorKind::kResource,
            error.what());
    require(std::string(error.what()).starts_with(folder), error.what());
    return {{}, error.what()};
  }
}

inline void compare(const PartsReading& one, const PartsReading& other) {
  require(one.error == other.error, "'" + one.error + "' is '" + other.error + "'");
  require(one.values == other.values, "the values do not depend on the blocks");
}

}  // namespace atlasgauge::fuzz
