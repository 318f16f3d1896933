#include <optional>
#include <string>

#include "io/tiles/b3dm_reader.hpp"
#include "io/tiles/tileset_reader.hpp"
#include "tests/fuzz/compare_parts.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/gltf_bytes.hpp"
#include "tests/support/temp_dir.hpp"

// Any tileset beside good tiles, and any tile in a good tileset, gives values or an error.
namespace atlasgauge {
namespace {

constexpr GltfLimits kLimits{{std::uint64_t{1} << 20, 64}, 256};

/// One folder for all inputs, with the files that a tileset may name: a.b3dm, b.glb, c.cmpt, and
/// the external d.json.
class Folder {
 public:
  Folder() {
    const std::string glb = make_glb(
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
            "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]})",
        bytes_of<float>(0, 0, 0, 1, 0, 0, 0, 1, 0));
    const std::string b3dm = make_b3dm(glb, R"({"RTC_CENTER":[1,2,3]})");
    dir_.write("a.b3dm", b3dm);
    dir_.write("b.glb", glb);
    dir_.write("c.cmpt", make_cmpt(b3dm, b3dm));
    dir_.write("d.json", R"({"asset":{"version":"1.1"},"root":{"content":{"uri":"a.b3dm"}}})");
    dir_.write("of_tile.json", R"({"asset":{"version":"1.0"},"root":{"content":{"uri":"tile"}}})");
  }

  const TempDir& dir() const { return dir_; }

 private:
  TempDir dir_;
};

const TempDir& folder() {
  static const Folder files;
  return files.dir();
}

void read_tileset(const std::string& path, std::optional<std::uint32_t> cut) {
  const auto make_reader = [&](Warnings& warnings) {
    return TilesetReader(path, cut, kLimits, warnings);
  };
  fuzz::read_parts_of(make_reader, folder().path().string());
}

void read_tile(const std::string& path) {
  const auto make_reader = [&](Warnings& warnings) { return B3dmReader(path, kLimits, warnings); };
  fuzz::read_parts_of(make_reader, folder().path().string());
}

void read(FuzzedDataProvider& input) {
  const auto cut = input.ConsumeIntegralInRange<std::uint32_t>(0, 4);
  const bool is_tile = input.ConsumeBool();
  const std::string bytes = input.ConsumeRemainingBytesAsString();
  if (is_tile) {
    const std::string tile = folder().write("tile", bytes);
    read_tile(tile);
    read_tileset((folder().path() / "of_tile.json").string(), std::nullopt);
  } else {
    const std::string tileset = folder().write("tileset.json", bytes);
    read_tileset(tileset, cut == 4 ? std::nullopt : std::optional(cut));
  }
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  FuzzedDataProvider input(data, bytes);
  atlasgauge::read(input);
  return 0;
}
