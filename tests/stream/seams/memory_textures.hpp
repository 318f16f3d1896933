#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/texture/texture_slots.hpp"
#include "stream/mesh/triangle.hpp"
#include "tests/support/memory_image.hpp"

namespace atlasgauge {

/// Textures of images in memory, named "image0" and so on, each with a material of its own.
class MemoryTextures {
 public:
  SlotId add(const MemoryImage& image) {
    const std::string name = "image" + std::to_string(slots_.slots.size());
    images_[name] = image;
    TextureSlot& slot = slots_.slots.emplace_back();
    slot.name = slot.source.path = name;
    slot.size = image.header.size;
    slot.readable = true;
    slot.kind = image.header.kind;
    slot.decoder_bytes = image.header.decoder_bytes;
    slots_.has_images = true;
    const SlotId id{static_cast<std::uint32_t>(slots_.slots.size() - 1)};
    slots_.of_material.push_back(id);
    SlotFrame frame;
    frame.has_size = frame.readable = true;
    frame.width = image.header.size.width;
    frame.height = image.header.size.height;
    frames_.push_back(frame);
    return id;
  }

  std::size_t size() const { return frames_.size(); }
  const TextureSlots& slots() const { return slots_; }
  TextureSlots& slots() { return slots_; }
  const std::vector<SlotFrame>& frames() const { return frames_; }
  const MemoryImage& image(SlotId slot) const {
    return images_.at(slots_.slots[raw(slot)].source.path);
  }
  OpenImage open() const { return open_from(images_); }

 private:
  TextureSlots slots_;
  std::vector<SlotFrame> frames_;
  std::map<std::string, MemoryImage> images_;
};

/// An image of any kind whose components tell texels apart, and are stored exactly.
inline MemoryImage distinct_texels(ImageSize size, TexelKind kind,
                                   std::uint64_t decoder_bytes = 0) {
  return {{.size = size, .kind = kind, .decoder_bytes = decoder_bytes},
          [](std::uint32_t column, std::uint32_t row, int channel) {
            return (column * 7 + row * 31 + static_cast<std::uint32_t>(channel) * 89) % 251;
          }};
}

}  // namespace atlasgauge
