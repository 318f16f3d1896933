#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "io/error.hpp"
#include "io/ply/ply_reader.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/collect_sink.hpp"
#include "tests/support/text_source.hpp"

// Any bytes give values or an error with its file, and the same ones however they are cut into
// blocks. Faces name vertices that exist.
namespace atlasgauge {
namespace {

/// What was read, or the text of the error.
struct Reading {
  CollectSink mesh;
  std::string warnings;
  std::string error;
};

Reading read_in_blocks(const std::string& bytes, std::size_t bytes_a_read,
                       std::size_t block_bytes) {
  Reading reading;
  Warnings warnings([&](const std::string& text) { reading.warnings += text + '\n'; });
  PlyReader reader(std::make_unique<TextSource>(bytes, bytes_a_read), "model.ply", block_bytes);
  try {
    const std::unique_ptr<MeshPart> part = reader.next();
    part->load();
    part->emit(reading.mesh, warnings);
    fuzz::require(reading.mesh.positions.size() == part->counts().positions,
                  "a file that is read has all its vertices");
  } catch (const Error& error) {
    const bool is_known = error.kind() == ErrorKind::kInput || error.kind() == ErrorKind::kResource;
    fuzz::require(is_known, error.what());
    reading.error = error.what();
    fuzz::require(reading.error.starts_with("model.ply:"), "the error names the file");
  }
  return reading;
}

/// NaN is not equal to itself, so values are compared as bits.
template <class T>
std::string bits(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

auto values_of(const Reading& reading) {
  return std::tuple(bits(reading.mesh.positions), bits(reading.mesh.texcoords),
                    bits(reading.mesh.faces), reading.mesh.forward.size(),
                    reading.mesh.invalid_polygons, reading.warnings);
}

void check_indices(const CollectSink& mesh) {
  for (const FaceRecord& face : mesh.faces) {
    for (int corner = 0; corner < 3; ++corner) {
      fuzz::require(raw(face.v[corner]) < mesh.positions.size(), "vertices exist");
      const bool has_texcoord =
          face.t[corner] == kNone<TexCoordId> || raw(face.t[corner]) < mesh.texcoords.size();
      fuzz::require(has_texcoord, "texture coordinates exist");
    }
  }
}

void read_both_ways(FuzzedDataProvider& input) {
  const auto block_bytes = input.ConsumeIntegralInRange<std::size_t>(64, 400);
  const auto bytes_a_read = input.ConsumeIntegralInRange<std::size_t>(1, 100);
  const std::string bytes = input.ConsumeRemainingBytesAsString();
  const Reading whole = read_in_blocks(bytes, SIZE_MAX, 1 << 16);
  const Reading cut = read_in_blocks(bytes, bytes_a_read, block_bytes);
  fuzz::require(whole.error == cut.error, "'" + whole.error + "' is '" + cut.error + "'");
  fuzz::require(values_of(whole) == values_of(cut), "the values do not depend on the blocks");
  if (whole.error.empty()) check_indices(whole.mesh);
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  FuzzedDataProvider input(data, bytes);
  atlasgauge::read_both_ways(input);
  return 0;
}
