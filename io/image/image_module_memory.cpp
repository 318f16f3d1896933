#include "io/image/image_module_memory.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>

#include "io/image/image_module_bytes.hpp"

namespace atlasgauge {
namespace {

/// State of the libraries, and a buffer of each step for the rows asked for at once. Measured, as
/// is all of this file, with OpenImageIO 2.4.7 and images of 4096 and 8192 texels in a square.
constexpr std::uint64_t kStateBytes = 7 << 20;
constexpr std::uint64_t kScratchBytes = 1 << 20;

/// Headers name what they like: sizes are held below the greatest number.
std::uint64_t product(std::initializer_list<std::uint64_t> factors) {
  std::uint64_t value = 1;
  for (const std::uint64_t factor : factors) {
    if (__builtin_mul_overflow(value, factor, &value)) {
      return std::numeric_limits<std::uint64_t>::max() / 16;
    }
  }
  return std::min(value, std::numeric_limits<std::uint64_t>::max() / 16);
}

std::uint64_t positive(int value) {
  return static_cast<std::uint64_t>(std::max(value, 1));
}

/// Bytes of the rows as stored; decoded to float they are no more than four times as many.
std::uint64_t native_bytes(const OIIO::ImageSpec& spec, std::uint64_t rows) {
  return product({positive(spec.width), rows, spec.pixel_bytes(true)});
}

std::uint64_t image_bytes(const OIIO::ImageSpec& spec) {
  return product({native_bytes(spec, positive(spec.height)), positive(spec.depth)});
}

/// How often the library holds tiles: a few at most where they are read in place, a row of them
/// where their type differs, and another row where they reach over the edge.
std::uint64_t native_tiles(const OIIO::ImageSpec& spec, std::uint64_t across, bool same_type) {
  if (spec.width % spec.tile_width != 0 || spec.height % spec.tile_height != 0) return 2 * across;
  return same_type ? std::min<std::uint64_t>(across, 4) : across;
}

/// The row of tiles that is kept, decoded, and tiles it comes from.
std::uint64_t tile_bytes(const OIIO::ImageSpec& spec, std::uint64_t texel_bytes) {
  const std::uint64_t tile_texels =
      product({positive(spec.tile_width), positive(spec.tile_height), positive(spec.tile_depth)});
  const std::uint64_t across =
      (positive(spec.width) + positive(spec.tile_width) - 1) / positive(spec.tile_width);
  const bool same_type = texel_bytes == spec.pixel_bytes(true);
  return product({across, tile_texels, texel_bytes}) +
         product({native_tiles(spec, across, same_type), tile_texels, spec.pixel_bytes(true)});
}

/// A strip that is compressed is read as a whole before it is decoded in rows. Some colour spaces
/// are decoded as a whole, to four bytes a texel.
std::uint64_t tiff_bytes(const OIIO::ImageSpec& spec, std::uint64_t texel_bytes,
                         std::uint64_t file_bytes) {
  constexpr int kYCbCr = 6;
  const std::string compression = spec.get_string_attribute("compression");
  const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation");
  const std::uint64_t tiles = spec.tile_width > 0 ? tile_bytes(spec, texel_bytes) : 0;
  if (compression == "jpeg" || photometric >= kYCbCr) {
    return product({positive(spec.width), positive(spec.height), 4}) + tiles +
           std::min(file_bytes, image_bytes(spec));
  }
  if (spec.tile_width > 0) return tiles;
  if (compression == "none") return 0;
  const auto rows = static_cast<std::uint64_t>(
      std::clamp(spec.get_int_attribute("tiff:RowsPerStrip", spec.height), 1, spec.height));
  return std::min(file_bytes, product({native_bytes(spec, rows), 2}));
}

/// Rows that are compressed together.
std::uint64_t exr_block_rows(const std::string& compression) {
  if (compression == "none" || compression == "rle" || compression == "zips") return 1;
  if (compression == "zip" || compression == "pxr24") return 16;
  return compression == "dwab" ? 256 : 32;
}

/// Blocks as stored and decoded, with what decoding takes, and tables of all rows.
std::uint64_t exr_bytes(const OIIO::ImageSpec& spec, std::uint64_t texel_bytes) {
  constexpr std::uint64_t kTableBytes = 24;
  if (spec.tile_width > 0) return tile_bytes(spec, texel_bytes);
  const std::uint64_t rows = exr_block_rows(spec.get_string_attribute("compression"));
  return product({native_bytes(spec, rows), 3}) + kTableBytes * positive(spec.height);
}

/// With interlacing, every row is spread over the whole file.
bool is_interlaced_png(const std::string& path) {
  constexpr std::uint64_t kInterlaceMethod = 28;
  HeaderBytes file(path);
  file.seek(kInterlaceMethod);
  return file.byte() != 0;
}

/// What the format makes the library hold, besides what every image takes.
std::uint64_t held_bytes(const std::string& path, const std::string& format,
                         const OIIO::ImageSpec& spec, std::uint64_t texel_bytes) {
  if (format == "png") return is_interlaced_png(path) ? image_bytes(spec) : 0;
  if (format == "openexr") return exr_bytes(spec, texel_bytes);
  if (format == "tiff") return tiff_bytes(spec, texel_bytes, HeaderBytes(path).file_bytes());
  if (format == "jpeg2000") return product({image_bytes(spec), 6});  // 32 bits a sample, twice
  if (format == "heif") return product({image_bytes(spec), 4});
  for (const char* in_rows :
       {"jpeg", "bmp", "hdr", "psd", "sgi", "rla", "dpx", "cineon", "fits", "zfile"}) {
    if (format == in_rows) return 0;
  }
  return image_bytes(spec) + image_bytes(spec) / 6;  // unknown ones too
}

}  // namespace

std::uint32_t rows_at_once(const OIIO::ImageSpec& spec) {
  const std::uint64_t row_bytes = native_bytes(spec, 1);
  return static_cast<std::uint32_t>(std::max<std::uint64_t>(kScratchBytes / row_bytes, 1));
}

std::uint64_t state_bytes(std::uint64_t row_bytes) {
  return kStateBytes + product({std::max(row_bytes, kScratchBytes), 2});
}

std::uint64_t decoder_bytes(const std::string& path, const std::string& format,
                            const OIIO::ImageSpec& spec, std::uint64_t texel_bytes) {
  // A row may be decoded from less to float, and all its channels with it.
  const std::uint64_t row_bytes = product({native_bytes(spec, 1), 4});
  return state_bytes(row_bytes) + held_bytes(path, format, spec, texel_bytes);
}

}  // namespace atlasgauge
