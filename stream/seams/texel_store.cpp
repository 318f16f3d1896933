#include "stream/seams/texel_store.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

TexelStore::TexelStore(std::vector<StoredImage> by_slot, std::vector<Spill<TexelPage>> spills)
    : by_slot_(std::move(by_slot)), spills_(std::move(spills)) {
  std::uint64_t tiles = 0;
  for (std::uint32_t slot = 0; slot < by_slot_.size(); ++slot) {
    StoredImage& image = by_slot_[slot];
    if (!image.decoded) continue;
    image.first_tile = static_cast<std::uint32_t>(tiles);
    tiles += image.layout.tile_count();
    if (tiles > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(ErrorKind::kResource,
                  "the textures have more than 2^32 tiles of 64 x 64 texels, which is the limit");
    }
    decoded_.push_back(slot);
    const std::uint64_t pages = image.layout.tile(0).pages;  // no tile is larger than the first
    largest_tile_pages_ = std::max(largest_tile_pages_, pages);
  }
  tile_count_ = static_cast<std::uint32_t>(tiles);
}

const StoredImage& TexelStore::image_of(std::uint32_t tile) const {
  const auto after = std::upper_bound(
      decoded_.begin(), decoded_.end(), tile,
      [&](std::uint32_t t, std::uint32_t slot) { return t < by_slot_[slot].first_tile; });
  return by_slot_[*(after - 1)];
}

LoadedTile TexelStore::find(std::uint32_t number) const {
  const StoredImage& image = image_of(number);
  const ImageTile tile = image.layout.tile(number - image.first_tile);
  return {&image, tile, resident(image, tile)};
}

const std::byte* TexelStore::resident(const StoredImage& image, const ImageTile& tile) const {
  const Spill<TexelPage>& spill = spills_[image.spill];
  const std::size_t per_block = spill.records_per_block();
  const std::uint64_t page = image.first_page + tile.first_page;
  const std::size_t in_block = page % per_block;
  if (in_block + tile.pages > per_block) return nullptr;
  const std::byte* const block = spill.scratch()->resident(spill.block(page / per_block));
  return block == nullptr ? nullptr : block + in_block * sizeof(TexelPage);
}

void TexelStore::read(const StoredImage& image, std::uint64_t first_page, std::uint64_t pages,
                      std::byte* to) const {
  const Spill<TexelPage>& spill = spills_[image.spill];
  const Scratch& scratch = *spill.scratch();
  const std::size_t per_block = spill.records_per_block();
  for (std::uint64_t page = image.first_page + first_page; pages > 0;) {
    const Scratch::BlockId block = spill.block(page / per_block);
    const std::size_t in_block = page % per_block;
    const auto count = std::min<std::uint64_t>(pages, per_block - in_block);
    const std::size_t offset = in_block * sizeof(TexelPage), bytes = count * sizeof(TexelPage);
    if (const std::byte* const memory = scratch.resident(block)) {
      std::memcpy(to, memory + offset, bytes);
    } else {
      scratch.read(block, offset, to, bytes);
    }
    page += count;
    pages -= count;
    to += bytes;
  }
}

}  // namespace atlasgauge
