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
  }
  tile_count_ = static_cast<std::uint32_t>(tiles);
}

const StoredImage& TexelStore::image_of(std::uint32_t tile) const {
  const auto after = std::upper_bound(
      decoded_.begin(), decoded_.end(), tile,
      [&](std::uint32_t t, std::uint32_t slot) { return t < by_slot_[slot].first_tile; });
  return by_slot_[*(after - 1)];
}

LoadedTile TexelStore::load(std::uint32_t number, AlignedBytes& memory) const {
  const StoredImage& image = image_of(number);
  const ImageTile tile = image.layout.tile(number - image.first_tile);
  return {&image, tile, load_pages(image, tile, memory)};
}

const std::byte* TexelStore::load_pages(const StoredImage& image, const ImageTile& tile,
                                        AlignedBytes& memory) const {
  const Spill<TexelPage>& spill = spills_[image.spill];
  const Scratch& scratch = *spill.scratch();
  const std::size_t per_block = spill.records_per_block();
  std::uint64_t page = image.first_page + tile.first_page;
  for (std::uint32_t done = 0; done < tile.pages;) {
    const std::size_t block = page / per_block;
    const std::size_t offset = page % per_block * sizeof(TexelPage);
    const auto count = static_cast<std::uint32_t>(
        std::min<std::size_t>(tile.pages - done, per_block - page % per_block));
    const std::byte* const resident = scratch.resident(spill.block(block));
    if (resident != nullptr && count == tile.pages) return resident + offset;
    if (!memory) memory = AlignedBytes(kLargestTileBytes);
    std::byte* const to = memory.data() + done * sizeof(TexelPage);
    const std::size_t bytes = count * sizeof(TexelPage);
    resident != nullptr ? static_cast<void>(std::memcpy(to, resident + offset, bytes))
                        : scratch.read(spill.block(block), offset, to, bytes);
    done += count;
    page += count;
  }
  return memory.data();
}

}  // namespace atlasgauge
