#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "io/texture/image_reader.hpp"

namespace atlasgauge {

/// Sizes of the readable images by file name.
using ImageSizes = std::map<std::string, std::pair<std::uint32_t, std::uint32_t>>;

/// Images that exist only as sizes. Their kind and their colours follow from the seed and the file
/// name: noise, slopes or one colour; some end in an error at one of their rows.
class ProceduralImages {
 public:
  ProceduralImages(ImageSizes sizes, std::uint64_t seed);

  ImageProbe probe() const;
  OpenImage open() const;

 private:
  ImageSizes sizes_;
  std::uint64_t seed_;
};

}  // namespace atlasgauge
