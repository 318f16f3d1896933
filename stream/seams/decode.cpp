#include "stream/seams/decode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "io/bytes.hpp"
#include "io/error.hpp"

namespace atlasgauge {
namespace {

TileLayout layout_of(const TextureSlot& slot) {
  return {*slot.size, slot.kind};
}

/// By how much to raise --memory for so many bytes more. As long as the engine grows with it, up to
/// half of a raise goes to the resident pool, to larger blocks and to more threads
/// (memory_plan.cpp).
std::uint64_t raise_bytes(const Engine& engine, std::uint64_t missing_bytes) {
  constexpr std::uint64_t kMostLostBytes = 512 << 20;
  const std::uint64_t larger_blocks_bytes = (engine.workers.count() + 8) * engine.block_bytes();
  return missing_bytes + std::min(2 * missing_bytes, kMostLostBytes) + larger_blocks_bytes;
}

/// Beyond what is spare, memory comes out of the budget.
Reservation reserve(const Engine& engine, std::uint64_t bytes, const DecodePlan& plan,
                    const TextureSlot& largest) {
  const std::uint64_t from_budget_bytes = bytes - std::min(bytes, plan.spare_bytes);
  const std::uint64_t free_bytes = engine.budget.free_bytes();
  if (from_budget_bytes <= free_bytes) {
    return engine.budget.reserve(from_budget_bytes, "decoding images");
  }
  const std::uint64_t missing_bytes = from_budget_bytes - free_bytes;
  throw Error(
      ErrorKind::kResource, largest.source.path, 0,
      fmt::format("decoding this image ({} x {} texels) takes {} of memory, which is {} "
                  "more than there is; raise --memory by {} MiB",
                  largest.size->width, largest.size->height, format_bytes(bytes),
                  format_bytes(missing_bytes), (raise_bytes(engine, missing_bytes) >> 20) + 1));
}

/// The slots that materials of the faces name.
std::vector<bool> named_slots(const TextureSlots& textures) {
  std::vector<bool> named(textures.slots.size(), false);
  const auto name = [&](SlotId slot) {
    if (slot != kNone<SlotId>) named[raw(slot)] = true;
  };
  for (const SlotId slot : textures.of_material) name(slot);
  name(textures.without_material);
  return named;
}

/// What one worker decodes.
class Decoder {
 public:
  explicit Decoder(Scratch& scratch) : pages_(scratch) {}

  /// The first page of the image. Throws Error(kInput).
  std::uint64_t decode(const TextureSlot& slot, const OpenImage& open) {
    const TileLayout layout = layout_of(slot);
    const std::unique_ptr<ImageRows> rows = open(slot.source);
    require_as_before(rows->header(), slot);
    const std::uint64_t first_page = pages_.size();
    if (band_.size() < layout.band_bytes()) band_ = std::vector<std::byte>(layout.band_bytes());
    for (std::uint32_t row = 0; row < layout.rows(); ++row) {
      const std::uint64_t first_tile = std::uint64_t{row} * layout.columns();
      rows->read(layout.tile(first_tile).height, band_.data());
      write_band(*slot.size, texel_bytes(slot.kind), layout, first_tile);
    }
    return first_page;
  }

  Spill<TexelPage> finish() { return pages_.finish(); }

 private:
  static void require_as_before(const ImageHeader& header, const TextureSlot& slot) {
    if (header.size.width == slot.size->width && header.size.height == slot.size->height &&
        header.kind == slot.kind) {
      return;
    }
    throw Error(ErrorKind::kInput, slot.source.path, 0,
                "the image has changed since the run began");
  }

  void write_band(ImageSize size, std::uint32_t bytes_of_texel, const TileLayout& layout,
                  std::uint64_t first_tile) {
    const std::size_t band_row_bytes = std::size_t{size.width} * bytes_of_texel;
    for (std::uint32_t column = 0; column < layout.columns(); ++column) {
      const ImageTile tile = layout.tile(first_tile + column);
      const std::size_t row_bytes = std::size_t{tile.width} * bytes_of_texel;
      tile_.resize(tile.pages);
      std::byte* to = tile_.data()->bytes;
      const std::byte* from =
          band_.data() + std::size_t{column} * TileLayout::kSide * bytes_of_texel;
      for (std::uint32_t y = 0; y < tile.height; ++y) {
        std::memcpy(to, from, row_bytes);
        to += row_bytes;
        from += band_row_bytes;
      }
      pages_.append(tile_);
    }
  }

  SpillWriter<TexelPage> pages_;
  std::vector<std::byte> band_;
  std::vector<TexelPage> tile_;
};

class ImageDecoding {
 public:
  ImageDecoding(const Engine& engine, const TextureSlots& textures, const DecodePlan& plan)
      : engine_(engine), textures_(textures), plan_(plan), by_slot_(textures.slots.size()) {
    for (std::size_t i = 0; i < engine.workers.count(); ++i) decoders_.emplace_back(engine.scratch);
    faults_.resize(textures.slots.size());
  }

  void run(const std::vector<bool>& wanted) {
    const std::uint64_t share_bytes =
        (engine_.budget.free_bytes() + plan_.spare_bytes) / engine_.workers.count();
    std::vector<std::uint32_t> together, alone;
    for (std::uint32_t slot = 0; slot < textures_.slots.size(); ++slot) {
      if (!wanted[slot]) continue;
      (need_of(slot) <= share_bytes ? together : alone).push_back(slot);
    }
    if (together.empty() && alone.empty()) return;
    StageLog::Stage stage(engine_.log, "decode images", together.size() + alone.size());
    decode_together(std::move(together), stage);
    for (const std::uint32_t slot : alone) {
      const Reservation memory = reserve(engine_, need_of(slot), plan_, textures_.slots[slot]);
      decode(0, slot);
    }
  }

  TexelStore finish(Warnings& warnings) {
    for (const std::optional<std::string>& fault : faults_) {
      if (!fault) continue;
      warnings.add("image undecodable", plan_.model, 0, *fault + "; its seams are not sampled");
    }
    std::vector<Spill<TexelPage>> spills;
    for (Decoder& decoder : decoders_) spills.push_back(decoder.finish());
    return {std::move(by_slot_), std::move(spills)};
  }

 private:
  std::uint64_t need_of(std::uint32_t slot) const {
    return image_need(textures_.slots[slot], engine_.block_bytes()).memory_bytes;
  }

  /// The largest first, so that workers end at about the same time.
  void decode_together(std::vector<std::uint32_t> slots, StageLog::Stage& stage) {
    if (slots.empty()) return;
    const auto texels = [&](std::uint32_t slot) {
      const ImageSize size = *textures_.slots[slot].size;
      return std::uint64_t{size.width} * size.height;
    };
    std::stable_sort(slots.begin(), slots.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return texels(a) > texels(b); });
    const auto neediest =
        std::max_element(slots.begin(), slots.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return need_of(a) < need_of(b); });
    const Reservation memory = reserve(engine_, engine_.workers.count() * need_of(*neediest), plan_,
                                       textures_.slots[*neediest]);
    engine_.workers.for_each(slots.size(), [&](std::size_t worker, std::size_t item) {
      decode(worker, slots[item]);
      if (worker == 0) stage.progress(item + 1);
    });
  }

  void decode(std::size_t worker, std::uint32_t number) {
    const TextureSlot& slot = textures_.slots[number];
    try {
      const std::uint64_t first_page = decoders_[worker].decode(slot, plan_.open_image);
      by_slot_[number] = {.decoded = true,
                          .kind = slot.kind,
                          .size = *slot.size,
                          .layout = layout_of(slot),
                          .spill = worker,
                          .first_page = first_page,
                          .first_tile = 0};
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      faults_[number] = error.what();
    }
  }

  const Engine& engine_;
  const TextureSlots& textures_;
  const DecodePlan& plan_;
  std::vector<Decoder> decoders_;
  std::vector<StoredImage> by_slot_;
  std::vector<std::optional<std::string>> faults_;  ///< by slot
};

}  // namespace

ImageNeed image_need(const TextureSlot& slot, std::size_t block_bytes) {
  const TileLayout layout = layout_of(slot);
  return {layout.page_count() * sizeof(TexelPage),
          layout.band_bytes() + slot.decoder_bytes + kLargestTileBytes + block_bytes};
}

void require_room_for_images(const Engine& engine, const TextureSlots& textures,
                             const DecodePlan& plan) {
  const std::vector<bool> named = named_slots(textures);
  const TextureSlot* largest = nullptr;
  std::uint64_t largest_bytes = 0;
  std::uint64_t all_bytes = 0;
  for (std::size_t i = 0; i < textures.slots.size(); ++i) {
    const TextureSlot& slot = textures.slots[i];
    if (!named[i] || !slot.readable) continue;
    const ImageNeed need = image_need(slot, engine.block_bytes());
    reserve(engine, need.memory_bytes, plan, slot);
    all_bytes += need.scratch_bytes;
    if (largest == nullptr || need.scratch_bytes > largest_bytes) {
      largest = &slot;
      largest_bytes = need.scratch_bytes;
    }
  }
  const std::uint64_t room_bytes = engine.scratch.room_bytes();
  if (all_bytes <= room_bytes) return;
  throw Error(ErrorKind::kResource, largest->source.path, 0,
              fmt::format("the images take {} of scratch when decoded, this one alone {} ({} x {} "
                          "texels), but there is room for {}; free space there or give another "
                          "directory with --tmp-dir",
                          format_bytes(all_bytes), format_bytes(largest_bytes),
                          largest->size->width, largest->size->height, format_bytes(room_bytes)));
}

TexelStore decode_images(const Engine& engine, const TextureSlots& textures,
                         const std::vector<bool>& wanted, const DecodePlan& plan,
                         Warnings& warnings) {
  ImageDecoding decoding(engine, textures, plan);
  decoding.run(wanted);
  return decoding.finish(warnings);
}

}  // namespace atlasgauge
