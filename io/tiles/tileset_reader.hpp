#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "io/file/file_listener.hpp"
#include "io/gltf/gltf_content.hpp"
#include "io/gltf/gltf_images.hpp"
#include "io/model/part_reader.hpp"
#include "io/tiles/tile_content.hpp"
#include "io/tiles/tile_part.hpp"
#include "io/tiles/tileset_walk.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Reads 3D Tiles, 1.0 and 1.1, as one model: the tiles that TilesetWalk chooses, in its order, and
/// of each tile the parts that GltfReader would hand out. Positions are, from the inside out: the
/// nodes of the glTF; its axis that is up turned to z (y unless asset.gltfUpAxis says otherwise:
/// (x, y, z) becomes (x, -z, y)); CESIUM_RTC and RTC_CENTER; the transforms of the tile and of
/// those above it.
///
/// A tile that cannot be read is like an image that cannot: it is left out, with a warning ("tiles
/// unreadable"). A driver need not tell such faults from others, because they stay within: next()
/// goes on to the next tile; a fault that load() finds is kept, and emit() then hands out nothing
/// and warns. So emit() of a part may hand out less than counts(), and it throws only where a file
/// has changed since load() or where warnings are errors; a driver then gives up.
///
/// One tile is open at a time, and none stays open; what grows with the tileset are its JSON and
/// the list of materials and images.
class TilesetReader : public PartReader {
 public:
  /// `cut`: the depth of the tiles to show; none: the leaves. Throws as TilesetWalk does.
  TilesetReader(const std::string& path, std::optional<std::uint32_t> cut, const GltfLimits& limits,
                Warnings& warnings, FileListener files = {});

  /// Throws Error(kInput) after the last tile if none could be read, and what TilesetWalk throws.
  std::unique_ptr<MeshPart> next() override;
  const PartMaterials& materials() const override { return images_.materials(); }

 private:
  void open(const TileFile& file);
  void open_gltf(const TileGltf& tile, const TileFile& file, std::size_t number,
                 const std::shared_ptr<TileState>& state);
  void warn(const std::string& text);
  bool warn_of_walk();
  void check_any_read() const;

  std::string path_;
  GltfLimits limits_;
  Warnings& warnings_;
  FileListener files_;
  TilesetWalk walk_;
  GltfImages images_;
  std::deque<std::unique_ptr<MeshPart>> parts_;  // of the open tile
  bool has_read_ = false;                        // a part has been handed out
  std::uint64_t unreadable_ = 0;
  std::string first_fault_;
};

}  // namespace atlasgauge
