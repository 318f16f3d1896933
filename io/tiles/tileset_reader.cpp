#include "io/tiles/tileset_reader.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "io/error.hpp"
#include "io/tiles/tile_part.hpp"

namespace atlasgauge {

TilesetReader::TilesetReader(const std::string& path, std::optional<std::uint32_t> cut,
                             const GltfLimits& limits, Warnings& warnings, FileListener files)
    : path_(path),
      limits_(limits),
      warnings_(warnings),
      files_(std::move(files)),
      walk_(path, cut, limits.json, files_),
      images_(path, limits.json.memory_bytes) {}

std::unique_ptr<MeshPart> TilesetReader::next() {
  while (parts_.empty()) {
    const std::optional<TileFile> file = walk_.next();
    const bool has_faults = warn_of_walk();
    if (file) {
      open(*file);
    } else if (!has_faults) {
      check_any_read();
      return nullptr;
    }
  }
  std::unique_ptr<MeshPart> part = std::move(parts_.front());
  parts_.pop_front();
  has_read_ = true;
  return part;
}

void TilesetReader::open(const TileFile& file) {
  files_.tell(file.path);
  try {
    const std::vector<TileGltf> found =
        find_in_tile(whole_file(file.path), limits_.json, warnings_);
    const auto tile = std::make_shared<TileState>(TileState{path_});
    for (std::size_t i = 0; i < found.size(); ++i) open_gltf(found[i], file, i, tile);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    parts_.clear();
    warn(error.what());
  }
}

void TilesetReader::open_gltf(const TileGltf& tile, const TileFile& file, std::size_t number,
                              const std::shared_ptr<TileState>& state) {
  const GltfFrame frame{file.transform * tile.rtc, to_z_up(file.up)};
  const std::string suffix = number == 0 ? "" : fmt::format("#{}", number);
  const GltfOrigin origin{file.path + suffix, file.label + suffix, false};
  GltfContent content(tile.gltf, frame, limits_, origin, images_, files_, warnings_);
  while (std::unique_ptr<MeshPart> part = content.next()) {
    parts_.push_back(std::make_unique<TilePart>(std::move(part), state));
  }
}

void TilesetReader::warn(const std::string& text) {
  ++unreadable_;
  if (first_fault_.empty()) first_fault_ = text;
  warnings_.add(kTileUnreadable, path_, 0, text + "; the tile is left out");
}

bool TilesetReader::warn_of_walk() {
  const std::vector<std::string> faults = walk_.take_faults();
  for (const std::string& fault : faults) warn(fault);
  return !faults.empty();
}

void TilesetReader::check_any_read() const {
  if (has_read_) return;
  if (unreadable_ == 0) {
    throw Error(ErrorKind::kInput, path_, 0,
                "found no tile with triangles in the tileset, or none at this level of detail");
  }
  throw Error(ErrorKind::kInput, path_, 0,
              fmt::format("none of the tiles could be read ({} faults), the first: {}", unreadable_,
                          first_fault_));
}

}  // namespace atlasgauge
