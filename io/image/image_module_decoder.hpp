#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/image/image_header.hpp"

namespace atlasgauge {

/// Red, green and blue among the channels of an image.
struct ColourChannels {
  std::array<int, 3> of{};  ///< thrice the same where the image is grey
  int begin = 0;            ///< the range of channels to be read
  int end = 0;
};

/// An image that is decoded in bands from the top row down. Faults are std::runtime_error.
class Decoder {
 public:
  explicit Decoder(const char* path);

  const ImageHeader& header() const { return header_; }
  void read(std::uint32_t rows, std::byte* to);

 private:
  void open();
  std::size_t channel_bytes(TexelKind kind) const;
  void read_scanlines(std::uint32_t rows, std::byte* to);
  void read_tiles();
  std::uint32_t copy_from_tiles(std::uint32_t rows, std::byte* to);
  void spread(const std::byte* from, std::size_t texels, std::byte* to) const;
  void check(bool read);

  std::string path_;
  ImageHeader header_;
  std::unique_ptr<OIIO::ImageInput> image_;  ///< null where opening takes memory: until it is read
  OIIO::ImageSpec spec_;
  ColourChannels channels_;
  bool must_be_opaque_ = false;
  std::uint32_t next_row_ = 0;
  std::vector<std::byte> channel_rows_;  ///< where channels are not red, green and blue alone
  std::vector<std::byte> tile_rows_;     ///< a row of tiles, with the channels that are read
  std::uint32_t tile_rows_end_ = 0;      ///< the row behind them
};

}  // namespace atlasgauge
