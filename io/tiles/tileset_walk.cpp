#include "io/tiles/tileset_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "io/error.hpp"
#include "io/file/byte_range.hpp"
#include "io/file/file_path.hpp"
#include "io/file/uri.hpp"
#include "io/suffix.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

/// Tilesets that name each other, one within the other.
constexpr std::size_t kMostOpen = 64;

bool is_external(const std::string& uri) {
  return has_suffix(uri, ".json") || has_suffix(uri.substr(0, uri.find_first_of("?#")), ".json");
}

std::span<const std::string> contents_of(const Tileset& tileset, const Tile& tile) {
  return std::span(tileset.contents).subspan(tile.first_content, tile.contents);
}

bool has_external(const Tileset& tileset, const Tile& tile) {
  return std::ranges::any_of(contents_of(tileset, tile), is_external);
}

bool has_own_content(const Tileset& tileset, const Tile& tile) {
  return !std::ranges::all_of(contents_of(tileset, tile), is_external);
}

}  // namespace

TilesetWalk::TilesetWalk(const std::string& path, std::optional<std::uint32_t> cut,
                         const JsonLimits& limits, FileListener files)
    : cut_(cut.value_or(std::numeric_limits<std::uint32_t>::max())),
      limits_(limits),
      files_(std::move(files)),
      root_folder_(fs::path(path).parent_path()) {
  open(path, {}, UpAxis::kY, 0, false);
}

std::optional<TileFile> TilesetWalk::next() {
  while (!open_.empty()) {
    if (std::optional<TileFile> file = next_content()) return file;
    if (!faults_.empty()) return std::nullopt;
  }
  return std::nullopt;
}

std::vector<std::string> TilesetWalk::take_faults() {
  return std::exchange(faults_, {});
}

void TilesetWalk::open(const std::string& path, const Affine& transform, UpAxis up,
                       std::uint32_t base_depth, bool adds) {
  files_.tell(path);
  const ByteRange file = whole_file(path);
  Tileset tileset = parse_tileset(read_json(file, limits_left(), is_tileset_member), path, {adds});
  const UpAxis own_up = tileset.up.value_or(up);
  open_.push_back({one_spelling(path), fs::path(path).parent_path(), std::move(tileset), transform,
                   own_up, base_depth, file.size});
}

/// `parent` and `tile` are gone after it.
void TilesetWalk::open_external(const fs::path& path, const Open& parent, const Tile& tile) {
  check_circle(one_spelling(path));
  try {
    open(path.string(), parent.transform * parent.tileset.transforms[tile.transform], parent.up,
         parent.base_depth + tile.depth, tile.adds);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    faults_.emplace_back(error.what());
  }
}

JsonLimits TilesetWalk::limits_left() const {
  JsonLimits left = limits_;
  for (const Open& open : open_) {
    left.memory_bytes -= std::min(left.memory_bytes, open.json_bytes);
  }
  return left;
}

void TilesetWalk::check_circle(const std::string& path) const {
  if (std::ranges::find(open_, path, &Open::path) != open_.end()) {
    throw Error(ErrorKind::kInput, open_.back().path, 0,
                fmt::format("names the tileset {}, which it lies within itself: a circle", path));
  }
  if (open_.size() < kMostOpen) return;
  throw Error(ErrorKind::kInput, open_.back().path, 0,
              fmt::format("found more than {} tilesets one within the other", kMostOpen));
}

/// Nothing also where only a step was made.
std::optional<TileFile> TilesetWalk::next_content() {
  Open& open = open_.back();
  if (open.next_tile > 0) {
    const Tile& tile = open.tileset.tiles[open.next_tile - 1];
    if (open.next_content < tile.contents) {
      return follow(open.tileset.contents[tile.first_content + open.next_content++]);
    }
    if (!reaches_children(open, tile)) open.next_tile = tile.end;
  }
  if (open.next_tile == open.tileset.tiles.size()) {
    open_.pop_back();
    return std::nullopt;
  }
  ++open.next_tile;
  open.next_content = 0;
  return std::nullopt;
}

std::optional<TileFile> TilesetWalk::follow(const std::string& uri) {
  const Open& open = open_.back();
  const Tile& tile = open.tileset.tiles[open.next_tile - 1];
  const bool external = is_external(uri);
  if (!external && !is_shown(open, tile)) return std::nullopt;
  const std::optional<fs::path> file = file_of_uri(uri, open.folder);
  if (!file) {
    faults_.push_back(
        fmt::format("{}: a tile's content is at \"{}\", which is no file; "
                    "fetch it, and name the copy",
                    open.path, shown_uri(uri)));
    return std::nullopt;
  }
  if (external) {
    open_external(*file, open, tile);
    return std::nullopt;
  }
  return TileFile{file->lexically_normal().string(),
                  file->lexically_relative(root_folder_).lexically_normal().generic_string(),
                  open.transform * open.tileset.transforms[tile.transform], open.up};
}

bool TilesetWalk::is_shown(const Open& open, const Tile& tile) const {
  const bool is_leaf = !open.tileset.has_children(tile) && !has_external(open.tileset, tile);
  return is_leaf || tile.adds || open.base_depth + tile.depth >= cut_;
}

bool TilesetWalk::reaches_children(const Open& open, const Tile& tile) const {
  return open.base_depth + tile.depth < cut_ || !has_own_content(open.tileset, tile);
}

}  // namespace atlasgauge
