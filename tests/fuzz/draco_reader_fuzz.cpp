#include <memory>
#include <string>

#include "io/draco/draco_mesh.hpp"
#include "io/error.hpp"
#include "tests/fuzz/fuzz.hpp"

// Any bytes give a mesh or an error with its file. Its indices exist, and decoding takes no more
// than the header said: streams that would take more than a small machine has are not decoded.
namespace atlasgauge {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;
const std::string kPath = "model.drc";

void check(const DracoMesh& mesh) {
  double sum = 0;
  for (std::uint64_t i = 0; i < mesh.positions(); ++i) sum += mesh.position(i).x;
  for (std::uint64_t i = 0; i < mesh.texcoords(); ++i) sum += mesh.texcoord(i).u;
  for (std::uint64_t i = 0; i < mesh.faces(); ++i) {
    const FaceRecord face = mesh.face(i);
    for (int corner = 0; corner < 3; ++corner) {
      fuzz::require(raw(face.v[corner]) < mesh.positions(), "vertices exist");
      const bool has_texcoord =
          face.t[corner] == kNone<TexCoordId> || raw(face.t[corner]) < mesh.texcoords();
      fuzz::require(has_texcoord, "texture coordinates exist");
    }
    const bool has_material =
        face.material == kNone<MaterialId> || raw(face.material) < mesh.material_names().size();
    fuzz::require(has_material, "materials have names");
  }
  (void)sum;
}

void decode(const std::string& stream) {
  const DracoHeader header = read_draco_header(stream, stream.size(), kPath);
  fuzz::require(header.begin_bytes_needed == 0, "a whole stream is enough for its header");
  (void)read_draco_material_names(stream, header);
  if (header.decoding_bytes > kMostBytes) return;
  check(DracoMesh::decode(stream, {}, kPath));
}

/// Whatever is known of the beginning stays true when more is known.
void read_beginnings(const std::string& stream) {
  DracoHeader header;
  std::size_t bytes = 1;
  do {
    header = read_draco_header(stream.substr(0, bytes), stream.size(), kPath);
    fuzz::require(header.begin_bytes_needed == 0 || header.begin_bytes_needed > bytes,
                  "more bytes are asked for");
    bytes = header.begin_bytes_needed;
  } while (bytes != 0);
}

void read(const std::string& stream) {
  try {
    if (!stream.empty()) read_beginnings(stream);
    decode(stream);
  } catch (const Error& error) {
    const bool is_known = error.kind() == ErrorKind::kInput || error.kind() == ErrorKind::kResource;
    fuzz::require(is_known, error.what());
    fuzz::require(std::string(error.what()).starts_with(kPath), "the error names the file");
  }
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  atlasgauge::read({reinterpret_cast<const char*>(data), bytes});
  return 0;
}
