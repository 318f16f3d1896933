#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/model/affine.hpp"

namespace atlasgauge {

/// A tile of a tileset's JSON.
struct Tile {
  std::uint32_t depth = 0;          ///< 0: the root
  std::uint32_t transform = 0;      ///< in Tileset::transforms
  std::uint32_t first_content = 0;  ///< in Tileset::contents
  std::uint32_t contents = 0;
  std::uint32_t end = 0;  ///< in Tileset::tiles: past the last tile beneath
  bool adds = false;      ///< refine ADD: what it shows stays when its children are shown
};

/// The axis of a tile's glTF that is up.
enum class UpAxis { kX, kY, kZ };

/// Turns that axis to z, which is up in 3D Tiles.
Affine to_z_up(UpAxis up);

/// A tileset's JSON (3D Tiles 1.0 and 1.1).
struct Tileset {
  std::vector<Tile> tiles;  ///< depth first, in the order of the document
  std::vector<std::string> contents;
  std::vector<Affine> transforms;  ///< from a tile to the tileset, those of its parents included
  std::optional<UpAxis> up;        ///< asset.gltfUpAxis
  bool has_children(const Tile& tile) const { return tile.end > index_of(tile) + 1; }
  std::uint32_t index_of(const Tile& tile) const {
    return static_cast<std::uint32_t>(&tile - tiles.data());
  }
};

/// What an external tileset takes over from the tile that names it.
struct InheritedTile {
  bool adds = false;
};

/// Whether a member of the document is needed: what parse_tileset() looks at.
bool is_tileset_member(std::string_view key);

/// Throws Error(kInput) for a document that is no tileset, of an unknown version, with values of
/// the wrong kind, with implicit tiling, or one that requires an unknown extension.
Tileset parse_tileset(const nlohmann::json& document, const std::string& path,
                      const InheritedTile& inherited);

}  // namespace atlasgauge
