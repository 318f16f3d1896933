#include "io/texture/image_module_whole.hpp"

namespace atlasgauge {

std::optional<ImageHeader> header_of_image_held_whole(const std::string&) {
  return std::nullopt;
}

}  // namespace atlasgauge
