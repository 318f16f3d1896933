#include "io/texture/image_module_memory.hpp"

#include <algorithm>

namespace atlasgauge {
namespace {

constexpr std::uint64_t kScratchBytes = 1 << 20;

}  // namespace

std::uint32_t rows_at_once(const OIIO::ImageSpec& spec) {
  const std::uint64_t row_bytes = std::max<std::uint64_t>(spec.scanline_bytes(true), 1);
  return static_cast<std::uint32_t>(std::max<std::uint64_t>(kScratchBytes / row_bytes, 1));
}

std::uint64_t decoder_bytes(const std::string&, const std::string&, const OIIO::ImageSpec& spec) {
  return spec.image_bytes(true);
}

}  // namespace atlasgauge
