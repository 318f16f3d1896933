#include "stream/raster/atlas_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "io/file/safe_name.hpp"
#include "io/image/png_file.hpp"
#include "io/map/map_file.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/raster/bin_triangle.hpp"
#include "stream/raster/map_preview.hpp"
#include "stream/raster/map_tile.hpp"
#include "stream/raster/tile_grid.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint32_t kTileTexels = 256;
/// Where memory is short.
constexpr std::uint32_t kSmallTileTexels = 32;

const std::array<MapChannel, 5> kChannels{{{"n", MapValue::kFloat},
                                           {"chart", MapValue::kUint},
                                           {"s_f", MapValue::kFloat},
                                           {"qcd", MapValue::kFloat},
                                           {"sign", MapValue::kFloat}}};

/// A triangle on its way to a map.
struct MapTriangle {
  BinTriangle triangle;
  FaceLook look;

  std::uint32_t key() const { return triangle.bin; }
};

FaceLook look_of(std::uint32_t number, const AtlasFace& face, double area_3d, float distortion,
                 const SlotFrame& frame, double scaling_unit) {
  const double area_uv = face.area_uv(frame);
  const double scaling = std::abs(area_uv) / area_3d / scaling_unit;
  FaceLook look{number, 0, distortion, 0};
  if (std::isfinite(scaling)) look.scaling = static_cast<float>(scaling);
  if (area_uv != 0) look.sign = area_uv > 0 ? 1.0F : -1.0F;
  return look;
}

/// Sizes of the levels that the file has: until both sides are one texel.
std::vector<LevelSize> level_sizes(const MapFile& file) {
  std::vector<LevelSize> sizes;
  for (std::uint32_t level = 0; level < file.level_count(); ++level) {
    const ImageSize size = file.level_size(level);
    sizes.push_back({size.width, size.height});
  }
  return sizes;
}

/// One texture's map while it is drawn.
class SlotMap {
 public:
  SlotMap(const Engine& engine, const SlotFrame& frame, ImageSize size, std::uint32_t tile_texels,
          const std::string& exr_path)
      : engine_(engine),
        tile_texels_(tile_texels),
        memory_(engine.budget.reserve(memory_bytes(engine, size, tile_texels), "a map")),
        file_(exr_path, size, tile_texels, kChannels),
        levels_(level_sizes(file_)),
        frames_(at_levels(frame, levels_)),
        grid_(levels_, tile_texels),
        preview_(size),
        written_(grid_.tile_count(), false),
        tiles_(engine.workers.count(), MapTile(tile_texels)) {}

  void draw(Spill<MapTriangle> triangles) {
    KeyedGroups<MapTriangle>::Buckets bins = distribute(std::move(triangles));
    KeyedGroups<MapTriangle> groups(
        engine_,
        [&](std::size_t worker, std::span<MapTriangle> some) {
          MapTile& tile = tiles_[worker];
          tile.reset(grid_.rect_of(some[0].key()));
          for (const MapTriangle& triangle : some) draw_into(tile, triangle);
          write(some[0].key(), tile);
        },
        [&](std::uint32_t number, Spill<MapTriangle> some) {
          MapTile& tile = tiles_[0];
          tile.reset(grid_.rect_of(number));
          MapTriangle triangle;
          for (SpillReader<MapTriangle> reader(some); reader.read(triangle);) {
            draw_into(tile, triangle);
          }
          write(number, tile);
        });
    groups.process(std::move(bins));
  }

  /// After all triangles: the tiles that none of them touched, and both files.
  void commit(const std::string& png_path) {
    MapTile& blank = tiles_[0];
    for (std::uint32_t tile = 0; tile < grid_.tile_count(); ++tile) {
      if (written_[tile]) continue;
      blank.reset(grid_.rect_of(tile));
      write(tile, blank);
    }
    file_.commit();
    write_png(png_path, preview_.size(), preview_.rgb());
  }

 private:
  static std::uint64_t memory_bytes(const Engine& engine, ImageSize size,
                                    std::uint32_t tile_texels) {
    const std::uint64_t tile =
        MapTile::memory_bytes(tile_texels) + MapFile::write_bytes(tile_texels, kChannels.size());
    return MapFile::memory_bytes(size, tile_texels, kChannels.size()) +
           MapPreview::memory_bytes(size) + engine.workers.count() * tile;
  }

  KeyedGroups<MapTriangle>::Buckets distribute(Spill<MapTriangle> triangles) {
    const std::uint64_t copies = triangles.size() * levels_.size();
    return KeyedGroups<MapTriangle>::distribute(
        engine_, copies, grid_.tile_count(), "distributing triangles to tiles of a map",
        [&](auto push) {
          SpillReader<MapTriangle> reader(triangles, SpillReader<MapTriangle>::Mode::kConsume);
          MapTriangle triangle;
          while (reader.read(triangle)) {
            visit_touched(triangle.triangle, frames_, grid_, [&](std::uint32_t tile) {
              triangle.triangle.bin = tile;
              push(0, triangle);
            });
          }
        },
        KeyedGroups<MapTriangle>::even_buckets(engine_));
  }

  void draw_into(MapTile& tile, const MapTriangle& triangle) const {
    const SlotFrame& frame = frames_[grid_.level_of(triangle.key())];
    tile.draw(snapped(triangle.triangle, frame), triangle.look);
  }

  void write(std::uint32_t number, const MapTile& tile) {
    const std::uint32_t level = grid_.level_of(number);
    const std::int64_t down = levels_[level].height - tile.rect().y1;
    const std::array<MapTexels, kChannels.size()> channels{
        std::span(tile.count()), std::span(tile.chart()), std::span(tile.scaling()),
        std::span(tile.distortion()), std::span(tile.sign())};
    file_.write_tile(level, static_cast<std::uint32_t>(tile.rect().x0 / tile_texels_),
                     static_cast<std::uint32_t>(down / tile_texels_), channels);
    const std::lock_guard lock(mutex_);
    written_[number] = true;
    if (level == 0) preview_.add(tile);
  }

  const Engine& engine_;
  const std::uint32_t tile_texels_;
  const Reservation memory_;
  MapFile file_;
  const std::vector<LevelSize> levels_;
  const std::vector<SlotFrame> frames_;  ///< by level
  const TileGrid grid_;
  std::mutex mutex_;  ///< of the next two
  MapPreview preview_;
  std::vector<bool> written_;
  std::vector<MapTile> tiles_;  ///< by worker
};

/// All textures' maps.
class MapWriter {
 public:
  MapWriter(const Engine& engine, const SlotFrames& frames, const TextureSlots& textures,
            const std::string& folder)
      : engine_(engine),
        frames_(frames),
        textures_(textures),
        folder_(folder),
        written_(textures.slots.size(), false) {
    const std::uint64_t bytes = engine.workers.count() * MapTile::memory_bytes(kTileTexels);
    tile_texels_ = 8 * bytes <= engine.budget.free_bytes() ? kTileTexels : kSmallTileTexels;
  }

  void write(std::uint32_t slot, Spill<MapTriangle> triangles) {
    const std::string& texture = textures_.slots[slot].name;
    const auto path = [&](const char* suffix) {
      return folder_ + "/" + safe_file_name(slot, texture == "N/A" ? "none" : texture, suffix);
    };
    SlotMap map(engine_, frames_.of(SlotId{slot}), *textures_.slots[slot].size, tile_texels_,
                path(".exr"));
    map.draw(std::move(triangles));
    map.commit(path(".png"));
    written_[slot] = true;
  }

  /// The maps of textures without faces.
  void write_rest() {
    for (std::uint32_t slot = 0; slot < written_.size(); ++slot) {
      if (!written_[slot] && textures_.slots[slot].size) {
        write(slot, Spill<MapTriangle>(engine_.scratch));
      }
    }
  }

 private:
  const Engine& engine_;
  const SlotFrames& frames_;
  const TextureSlots& textures_;
  const std::string& folder_;
  std::uint32_t tile_texels_;
  std::vector<bool> written_;
};

KeyedGroups<MapTriangle>::Buckets distribute_to_slots(const Engine& engine, AtlasStore& atlas,
                                                      double scaling_unit) {
  const auto push_faces = [&](auto push) {
    SpillReader<Label> charts(atlas.charts, SpillReader<Label>::Mode::kConsume);
    SpillReader<AtlasFace> faces(atlas.faces, SpillReader<AtlasFace>::Mode::kConsume);
    SpillReader<double> areas_3d(atlas.areas_3d, SpillReader<double>::Mode::kConsume);
    SpillReader<float> distortions(atlas.distortions, SpillReader<float>::Mode::kConsume);
    Label chart;
    AtlasFace face;
    double area_3d = 0;
    float distortion = 0;
    for (std::uint32_t number = 0; charts.read(chart) && faces.read(face) &&
                                   areas_3d.read(area_3d) && distortions.read(distortion);
         ++number) {
      if (!face.is_drawn()) continue;
      const SlotFrame& frame = atlas.frames.of(face.slot());
      push(0, {{raw(face.slot()), chart.first(), {face.uv(0), face.uv(1), face.uv(2)}},
               look_of(number, face, area_3d, distortion, frame, scaling_unit)});
    }
  };
  return KeyedGroups<MapTriangle>::distribute(engine, atlas.faces.size(), atlas.frames.all().size(),
                                              "distributing triangles to maps", push_faces);
}

}  // namespace

void write_maps(const Engine& engine, AtlasStore atlas, const TextureSlots& textures,
                double scaling_unit, const std::string& folder) {
  StageLog::Stage stage(engine.log, "maps", textures.slots.size());
  KeyedGroups<MapTriangle>::Buckets bins = distribute_to_slots(engine, atlas, scaling_unit);
  MapWriter writer(engine, atlas.frames, textures, folder);
  // Every slot is handed over by itself: its map takes all workers.
  KeyedGroups<MapTriangle> slots(
      engine, [](std::size_t, std::span<MapTriangle>) {},
      [&](std::uint32_t slot, Spill<MapTriangle> triangles) {
        writer.write(slot, std::move(triangles));
        stage.progress(slot + 1);
      },
      0);
  slots.process(std::move(bins));
  writer.write_rest();
}

}  // namespace atlasgauge
