#include "stream/seams/long_seams.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stream/engine/page_cache.hpp"
#include "stream/seams/footprint_requests.hpp"

namespace atlasgauge {
namespace {

/// Of one worker; a few hundred kilobytes of 8-bit texels.
constexpr std::size_t kTiles = 32;

/// The texels of an image, looked up by their coordinates.
class TexelLookup {
 public:
  TexelLookup(const StoredImage& image, TileCache& tiles) : image_(&image), tiles_(&tiles) {}

  void read(const Footprint& footprint, CornerColours& corners) {
    for (std::int64_t c = 0; c < 4; ++c) {
      const std::int64_t x = repeated(footprint.x + c % 2, image_->size.width);
      const std::int64_t y = repeated(footprint.y + c / 2, image_->size.height);
      corners[static_cast<std::size_t>(c)] = colour(
          static_cast<std::uint32_t>(x), image_->size.height - 1 - static_cast<std::uint32_t>(y));
    }
  }

 private:
  Colour colour(std::uint32_t column, std::uint32_t row) {
    constexpr std::uint32_t kSide = TileLayout::kSide;
    const LoadedTile& tile =
        tiles_->at(image_->first_tile + row / kSide * image_->layout.columns() + column / kSide);
    return colour_of(tile.texel(column % kSide, row % kSide), image_->kind);
  }

  const StoredImage* image_;
  TileCache* tiles_;
};

/// What one worker samples with.
struct Sampler {
  PageCache<SeamCandidate> edges;
  TileCache tiles;
};

}  // namespace

void compare_along(const Engine& engine, const SeamEdges& edges, const TexelStore& store,
                   Spill<std::uint32_t> numbers, const OnCompared& on_edge) {
  if (numbers.empty()) return;
  StageLog::Stage stage(engine.log, "long seams", numbers.size());
  const std::size_t workers = engine.workers.count();
  const std::uint64_t page_bytes = PageLayout<SeamCandidate>::kBytes;
  const std::uint64_t fixed_bytes = workers * page_bytes + engine.block_bytes();
  const Reservation memory = engine.budget.reserve_between(
      fixed_bytes + workers * TileCache::bytes(1), fixed_bytes + workers * TileCache::bytes(kTiles),
      "sampling long seams");
  const std::size_t tiles = (memory.bytes() - fixed_bytes) / workers / TileCache::bytes(1);
  std::vector<Sampler> samplers;
  for (std::size_t i = 0; i < workers; ++i) {
    samplers.push_back(
        {PageCache<SeamCandidate>(edges.spill(), page_bytes), TileCache(store, tiles)});
  }
  BlockBuffer buffer;
  std::uint64_t done = 0;
  for (std::size_t block = 0; block < numbers.block_count(); ++block) {
    const auto some = numbers.load(block, buffer);
    engine.workers.for_each(some.size(), [&](std::size_t worker, std::size_t item) {
      Sampler& sampler = samplers[worker];
      const SeamCandidate edge = sampler.edges.at(some[item]);
      on_edge(worker, edge, edges.distances(edge, [&](std::size_t, std::size_t side) {
        return TexelLookup(store.image(edge.sides[side].slot), sampler.tiles);
      }));
    });
    stage.progress(done += some.size());
  }
}

}  // namespace atlasgauge
