#include <string>

#include "tests/fuzz/compare_model.hpp"

// OBJ text of any kind, measured by the pipeline and by the oracle. Distortion of slivers is what
// rounding left of them, so only counts must agree.
namespace atlasgauge {
namespace {

constexpr const char* kMaterials =
    "newmtl a\nmap_Kd a.png\nnewmtl b\n  map_Kd -s 1 1 1 b two.png\nnewmtl c\nnewmtl a\n"
    "map_Kd c.png\nnewmtl d\nmap_Kd missing.png\n";

/// What the program reads beyond the specification, and the oracle does not know.
bool is_beyond_oracle(const std::string& text) {
  const bool is_compressed = text.starts_with("\x1F\x8B") || text.starts_with("\x28\xB5\x2F\xFD");
  const bool has_mark = text.starts_with("\xEF\xBB\xBF") || text.starts_with("\xFF\xFE") ||
                        text.starts_with("\xFE\xFF");
  return is_compressed || has_mark || text.find('\0') != std::string::npos;
}

void run(FuzzedDataProvider& input) {
  static const fuzz::ModelFolder folder(
      {{"a.png", {64, 32}}, {"b two.png", {33, 8}}, {"c.png", {1, 1}}});
  folder.write_materials(kMaterials);
  const PipelineConfig config = fuzz::draw_config(input);
  const std::string text = input.ConsumeRemainingBytesAsString();
  if (!is_beyond_oracle(text)) folder.compare(text, config, Closeness::kCounts);
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  FuzzedDataProvider input(data, bytes);
  atlasgauge::run(input);
  return 0;
}
