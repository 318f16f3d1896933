#include "io/corpus/model_metadata.hpp"

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "io/error.hpp"
#include "io/file/byte_range.hpp"
#include "io/file/file_path.hpp"
#include "io/json/bounded_json.hpp"

namespace atlasgauge {
namespace {

constexpr JsonLimits kLimits{.memory_bytes = std::uint64_t{16} << 20, .depth = 64};

bool keep_all(std::string_view /*key*/) {
  return true;
}

std::optional<std::string> find_metadata(const std::string& root, const std::string& model) {
  std::filesystem::path folder = std::filesystem::path(model).parent_path();
  while (true) {
    const std::filesystem::path path = root / folder / "metadata.json";
    if (is_file(path)) return path.string();
    if (folder.empty()) return std::nullopt;
    folder = folder.parent_path();
  }
}

}  // namespace

std::optional<std::string> metadata_of(const std::string& root, const std::string& model,
                                       Warnings& warnings) {
  const std::optional<std::string> path = find_metadata(root, model);
  if (!path) return std::nullopt;
  try {
    const ByteRange file = whole_file(*path);
    if (read_json(file, kLimits, keep_all).is_object()) return read_range(file);
    warnings.add("metadata unreadable", *path, 0, "it is no JSON object; left out");
  } catch (const Error& error) {
    warnings.add("metadata unreadable", *path, 0, std::string("left out: ") + error.what());
  }
  return std::nullopt;
}

}  // namespace atlasgauge
