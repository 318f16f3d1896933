#include <string>

#include "io/gltf/gltf_reader.hpp"
#include "tests/fuzz/compare_parts.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/gltf_bytes.hpp"
#include "tests/support/temp_dir.hpp"

// Any bytes give values or an error, and the same ones however accessors are cut into blocks.
namespace atlasgauge {
namespace {

/// One folder for all inputs: making one a time would take longer than reading.
const TempDir& folder() {
  static const TempDir dir;
  return dir;
}

fuzz::PartsReading read_in_blocks(const std::string& path, std::size_t block_bytes) {
  const GltfLimits limits{{std::uint64_t{1} << 20, 64}, block_bytes};
  const auto make_reader = [&](Warnings& warnings) { return GltfReader(path, limits, warnings); };
  return fuzz::read_parts_of(make_reader, folder().path().string());
}

/// A text before a zero byte, with the rest as its binary chunk: headers that fit are hard to
/// guess.
std::string glb_of(const std::string& bytes) {
  const std::size_t end = bytes.find('\0');
  if (end == std::string::npos) return make_glb(bytes);
  return make_glb(bytes.substr(0, end), bytes.substr(end + 1));
}

void read_both_ways(FuzzedDataProvider& input) {
  const auto block_bytes = input.ConsumeIntegralInRange<std::size_t>(1, 2000);
  const bool is_made = input.ConsumeBool();
  const std::string bytes = input.ConsumeRemainingBytesAsString();
  const std::string path = folder().write("model.glb", is_made ? glb_of(bytes) : bytes);
  fuzz::compare(read_in_blocks(path, std::size_t{1} << 16), read_in_blocks(path, block_bytes));
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  FuzzedDataProvider input(data, bytes);
  atlasgauge::read_both_ways(input);
  return 0;
}
