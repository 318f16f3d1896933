#include "io/image/image_module_decoder.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "io/image/image_module_bytes.hpp"
#include "io/image/image_module_exr.hpp"
#include "io/image/image_module_faults.hpp"
#include "io/image/image_module_memory.hpp"
#include "io/image/image_module_whole.hpp"

namespace atlasgauge {
namespace {

[[noreturn]] void fail(const std::string& text) {
  throw std::runtime_error(text);
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// The program has threads of its own, each with an image.
bool use_no_threads() {
  return OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1);
}

/// Tried in this order, by the content of the file. The library knows more formats: of films, of
/// medicine and of cameras, none of textures, with readers that crash on damaged files.
constexpr std::array<const char*, 16> kFormats = {
    "png", "jpeg", "tiff", "openexr", "bmp", "webp", "gif",      "hdr",
    "psd", "dds",  "pnm",  "sgi",     "rla", "heif", "jpeg2000", "targa"};

void check_readable(const std::string& path) {
  if (std::ifstream(path).good()) return;
  fail(std::error_code(errno, std::generic_category()).message());
}

OIIO::ImageSpec as_stored() {
  OIIO::ImageSpec settings;
  settings.attribute("oiio:UnassociatedAlpha", 1);
  return settings;
}

/// Some readers do not know files that they can read; the error is that of one which knows it.
std::unique_ptr<OIIO::ImageInput> open_in_any_format(const std::string& path) {
  std::string error;
  const bool may_be_netpbm = HeaderBytes(path).byte() == 'P';
  for (const std::string format : kFormats) {
    if (format == "pnm" && !may_be_netpbm) continue;  // its reader reads all files whole
    std::unique_ptr<OIIO::ImageInput> image = OIIO::ImageInput::create(format);
    if (!image) continue;
    const bool is_known = image->valid_file(path);
    OIIO::ImageSpec spec;
    if (image->open(path, spec, as_stored())) return image;
    const std::string fault = last_line(image->geterror());
    if (is_known && error.empty()) error = fault;
  }
  fail(error.empty() ? "the file is no image of a known format" : error);
}

std::unique_ptr<OIIO::ImageInput> open_with_library(const std::string& path) {
  static const bool without_threads = use_no_threads();
  static_cast<void>(without_threads);
  check_readable(path);
  check_exr_tables(path);
  check_header_faults(path);
  std::unique_ptr<OIIO::ImageInput> image = open_in_any_format(path);
  image->threads(1);
  return image;
}

void check_spec(const OIIO::ImageSpec& spec) {
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) {
    fail("the header names an image without texels");
  }
  if (spec.deep) fail("its texels are lists of samples in depth");
}

TexelKind kind_of(const OIIO::ImageSpec& spec) {
  if (!spec.channelformats.empty()) return TexelKind::kFloat;
  if (spec.format == OIIO::TypeDesc::UINT8) return TexelKind::kByte;
  if (spec.format == OIIO::TypeDesc::UINT16) return TexelKind::kShort;
  return TexelKind::kFloat;
}

OIIO::TypeDesc type_of(TexelKind kind) {
  if (kind == TexelKind::kByte) return OIIO::TypeDesc::UINT8;
  if (kind == TexelKind::kShort) return OIIO::TypeDesc::UINT16;
  return OIIO::TypeDesc::FLOAT;
}

/// -1 if there is none. Some readers name fewer channels than there are.
int channel_of(const OIIO::ImageSpec& spec, const char* name) {
  const auto& names = spec.channelnames;
  const auto found = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<int>(found - names.begin());
  return found == names.end() || index >= spec.nchannels ? -1 : index;
}

ColourChannels colours_of(const OIIO::ImageSpec& spec) {
  if (spec.nchannels < 3) return {.of = {0, 0, 0}, .begin = 0, .end = 1};
  std::array<int, 3> of = {channel_of(spec, "R"), channel_of(spec, "G"), channel_of(spec, "B")};
  const auto [least, most] = std::minmax_element(of.begin(), of.end());
  if (*least < 0) return {.of = {0, 1, 2}, .begin = 0, .end = 3};
  const int begin = *least;
  const int end = *most + 1;
  for (int& channel : of) channel -= begin;
  return {.of = of, .begin = begin, .end = end};
}

/// These readers know no other colours than those multiplied by alpha, or none where alpha is 0.
bool loses_colours(const OIIO::ImageInput& image) {
  const std::string format = image.format_name();
  return image.spec().nchannels == 4 && (format == "webp" || format == "gif");
}

bool are_rgb(const ColourChannels& channels) {
  return channels.of == std::array<int, 3>{0, 1, 2} && channels.end - channels.begin == 3;
}

void check_opaque(const std::vector<std::byte>& rgba) {
  for (std::size_t alpha = 3; alpha < rgba.size(); alpha += 4) {
    if (rgba[alpha] != std::byte{255}) {
      fail(
          "it is transparent in places, where its colours cannot be read; "
          "save it as PNG or without transparency");
    }
  }
}

std::size_t component_bytes(TexelKind kind) {
  return texel_bytes(kind) / 3;
}

}  // namespace

Decoder::Decoder(const char* path) : path_(path) {
  const std::optional<ImageHeader> whole = header_of_image_held_whole(path_);
  if (whole) {
    header_ = *whole;
    header_.decoder_bytes +=
        state_bytes(std::uint64_t{header_.size.width} * texel_bytes(header_.kind));
    return;
  }
  open();
  header_.size = {static_cast<std::uint32_t>(spec_.width),
                  static_cast<std::uint32_t>(spec_.height)};
  header_.kind = kind_of(spec_);
  header_.decoder_bytes =
      decoder_bytes(path_, image_->format_name(), spec_, channel_bytes(header_.kind));
}

void Decoder::open() {
  image_ = open_with_library(path_);
  spec_ = image_->spec();
  check_spec(spec_);
  channels_ = colours_of(spec_);
  must_be_opaque_ = loses_colours(*image_);
  if (must_be_opaque_) channels_ = {.of = {0, 1, 2}, .begin = 0, .end = 4};
}

void Decoder::read(std::uint32_t rows, std::byte* to) {
  if (rows > header_.size.height - next_row_) fail("the image has no more rows");
  if (!image_) {
    open();
    if (static_cast<std::uint32_t>(spec_.width) != header_.size.width ||
        static_cast<std::uint32_t>(spec_.height) != header_.size.height ||
        kind_of(spec_) != header_.kind) {
      fail("its header and its texels do not agree");
    }
  }
  const std::size_t row_bytes = std::size_t{header_.size.width} * texel_bytes(header_.kind);
  const std::uint32_t band = rows_at_once(spec_);
  while (rows > 0) {
    const std::uint32_t now =
        spec_.tile_width > 0 ? copy_from_tiles(rows, to) : std::min(rows, band);
    if (spec_.tile_width == 0) read_scanlines(now, to);
    next_row_ += now;
    rows -= now;
    to += now * row_bytes;
  }
}

/// Bytes of a texel with all channels that are read.
std::size_t Decoder::channel_bytes(TexelKind kind) const {
  return static_cast<std::size_t>(channels_.end - channels_.begin) * component_bytes(kind);
}

void Decoder::read_scanlines(std::uint32_t rows, std::byte* to) {
  const std::size_t texels = std::size_t{header_.size.width} * rows;
  const bool direct = are_rgb(channels_);
  if (!direct) {
    channel_rows_.resize(texels * channel_bytes(header_.kind));
  }
  const int first = spec_.y + static_cast<int>(next_row_);
  check(image_->read_scanlines(0, 0, first, first + static_cast<int>(rows), spec_.z,
                               channels_.begin, channels_.end, type_of(header_.kind),
                               direct ? to : channel_rows_.data()));
  if (direct) return;
  if (must_be_opaque_) check_opaque(channel_rows_);
  spread(channel_rows_.data(), texels, to);
}

/// Reads the row of tiles that begins with the next row; of volumes, the first slice counts.
void Decoder::read_tiles() {
  const int rows = std::min(spec_.tile_height, spec_.height - static_cast<int>(next_row_));
  const int slices = std::clamp(spec_.tile_depth, 1, std::max(spec_.depth, 1));
  tile_rows_.resize(static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(rows) *
                    static_cast<std::size_t>(slices) * channel_bytes(header_.kind));
  const int first = spec_.y + static_cast<int>(next_row_);
  check(image_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, first, first + rows, spec_.z,
                           spec_.z + slices, channels_.begin, channels_.end, type_of(header_.kind),
                           tile_rows_.data()));
  tile_rows_end_ = next_row_ + static_cast<std::uint32_t>(rows);
}

/// Returns how many rows it has copied.
std::uint32_t Decoder::copy_from_tiles(std::uint32_t rows, std::byte* to) {
  if (next_row_ == tile_rows_end_) read_tiles();
  const auto tile_height = static_cast<std::uint32_t>(spec_.tile_height);
  const std::uint32_t row_in_tile = next_row_ % tile_height;
  const std::uint32_t copied = std::min(rows, tile_rows_end_ - next_row_);
  const std::size_t row_bytes = std::size_t{header_.size.width} * channel_bytes(header_.kind);
  spread(tile_rows_.data() + row_in_tile * row_bytes, std::size_t{header_.size.width} * copied, to);
  return copied;
}

/// Picks red, green and blue from the channels that are read.
void Decoder::spread(const std::byte* from, std::size_t texels, std::byte* to) const {
  const std::size_t bytes = component_bytes(header_.kind);
  const std::size_t step = channel_bytes(header_.kind);
  for (std::size_t texel = 0; texel < texels; ++texel, from += step) {
    for (const int channel : channels_.of) {
      std::memcpy(to, from + static_cast<std::size_t>(channel) * bytes, bytes);
      to += bytes;
    }
  }
}

void Decoder::check(bool read) {
  if (read && !image_->has_error()) return;
  const std::string error = last_line(image_->geterror());
  fail(error.empty() ? "its texels cannot be decoded" : error);
}

}  // namespace atlasgauge
