#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/file/file_listener.hpp"
#include "io/json/bounded_json.hpp"
#include "io/model/affine.hpp"
#include "io/tiles/tileset.hpp"

namespace atlasgauge {

/// The file of a tile, and where it goes.
struct TileFile {
  std::string path;
  std::string label;  ///< the path relative to the outermost tileset
  Affine transform;   ///< from the tile to the outermost tileset
  UpAxis up = UpAxis::kY;
};

/// Walks a tileset and those it names, depth first, and hands out the files of the tiles that are
/// shown together, one at a time:
///
/// - Depth counts from the root, 0. An external tileset (a content that ends in ".json") stands in
///   the place of the tile that names it: its root has the depth of that tile, its transform and,
///   where it says nothing itself, its `refine` and its axis that is up. So the depth of a tile
///   does not depend on how a tileset is cut into files.
/// - A tile is a leaf if it has neither children nor an external tileset.
/// - The cut at depth N shows each tile with content that is reached and is a leaf, or at depth N
/// or
///   deeper, or whose `refine` is ADD (such a tile stays when its children are shown, a REPLACE one
///   goes). Below a tile are reached: its external tilesets; its children, if its depth is less
///   than N or it has no content of its own (an empty tile stands for its children, as renderers
///   have it).
/// - Without N, the cut is below everything: leaves, and ADD tiles above them.
///
/// Holds the JSON of the tilesets from the outermost to the innermost open one, not those beside.
class TilesetWalk {
 public:
  /// `files` hears of the tilesets. Throws Error(kInput) for a tileset that is broken, and
  /// Error(kResource) for one beyond the limits.
  TilesetWalk(const std::string& path, std::optional<std::uint32_t> cut, const JsonLimits& limits,
              FileListener files);

  /// The next file, or nothing after the last. Throws Error(kInput) for tilesets that name each
  /// other in a circle, and Error(kResource).
  std::optional<TileFile> next();

  /// What next() could not follow since the last call, with paths: external tilesets that cannot
  /// be opened, and contents that name no file.
  std::vector<std::string> take_faults();

 private:
  struct Open {
    std::string path;  // in one spelling
    std::filesystem::path folder;
    Tileset tileset;
    Affine transform;
    UpAxis up;
    std::uint32_t base_depth;
    std::uint64_t json_bytes;
    std::uint32_t next_tile = 0;
    std::uint32_t next_content = 0;  // of the tile before next_tile
  };

  void open(const std::string& path, const Affine& transform, UpAxis up, std::uint32_t base_depth,
            bool adds);
  void open_external(const std::filesystem::path& path, const Open& parent, const Tile& tile);
  JsonLimits limits_left() const;
  void check_circle(const std::string& path) const;
  std::optional<TileFile> next_content();
  std::optional<TileFile> follow(const std::string& uri);
  bool is_shown(const Open& open, const Tile& tile) const;
  bool reaches_children(const Open& open, const Tile& tile) const;

  std::uint32_t cut_;
  JsonLimits limits_;
  FileListener files_;
  std::filesystem::path root_folder_;
  std::vector<Open> open_;
  std::vector<std::string> faults_;
};

}  // namespace atlasgauge
