#include "io/map/exr_output.hpp"

#include <algorithm>
#include <new>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr int kPart = 0;  // the only one

/// Higher levels took up to five times as long for a tenth less.
constexpr int kZipLevel = 1;

exr_pixel_type_t exr_type(MapValue value) {
  return value == MapValue::kFloat ? EXR_PIXEL_FLOAT : EXR_PIXEL_UINT;
}

/// The library would print it.
void keep_silent(exr_const_context_t, exr_result_t, const char*) {}

}  // namespace

ExrOutput::ExrOutput(const std::string& path, ImageSize size, std::uint32_t tile_texels,
                     std::span<const MapChannel> channels)
    : file_(path), channels_(channels.begin(), channels.end()) {
  exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
  start.user_data = this;
  start.write_fn = on_write;
  start.error_handler_fn = keep_silent;
  start.zip_level = kZipLevel;
  check(exr_start_write(&context_, this->path().c_str(), EXR_WRITE_FILE_DIRECTLY, &start));
  try {
    write_header(size, tile_texels);
  } catch (...) {
    exr_finish(&context_);
    throw;
  }
}

ExrOutput::~ExrOutput() {
  if (context_ != nullptr) exr_finish(&context_);
}

exr_chunk_info_t ExrOutput::tile(std::uint32_t level, std::uint32_t x, std::uint32_t y,
                                 ImageSize inside) {
  exr_chunk_info_t tile{};
  check(exr_write_tile_chunk_info(context_, kPart, static_cast<int>(x), static_cast<int>(y),
                                  static_cast<int>(level), static_cast<int>(level), &tile));
  // OpenEXR 3.1.5 cuts off all levels where it cuts off the first.
  tile.width = static_cast<std::int32_t>(inside.width);
  tile.height = static_cast<std::int32_t>(inside.height);
  tile.unpacked_size =
      std::uint64_t{inside.width} * inside.height * channels_.size() * kMapValueBytes;
  return tile;
}

ExrOutput::Compressed ExrOutput::compress(const exr_chunk_info_t& tile,
                                          std::span<const std::byte* const> texels,
                                          std::size_t row_bytes) {
  Compressed compressed;
  exr_encode_pipeline_t& encoder = *compressed.encoder_;
  check(exr_encoding_initialize(context_, kPart, &tile, &encoder));
  for (int i = 0; i < encoder.channel_count; ++i) {
    exr_coding_channel_info_t& channel = encoder.channels[i];
    const std::size_t number = number_of(channel.channel_name);
    channel.encode_from_ptr = reinterpret_cast<const std::uint8_t*>(texels[number]);
    channel.user_data_type = static_cast<std::uint16_t>(exr_type(channels_[number].value));
    channel.user_bytes_per_element = kMapValueBytes;
    channel.user_pixel_stride = kMapValueBytes;
    channel.user_line_stride = static_cast<std::int32_t>(row_bytes);
  }
  check(exr_encoding_choose_default_routines(context_, kPart, &encoder));
  encoder.yield_until_ready_fn = nullptr;
  encoder.write_fn = nullptr;
  check(exr_encoding_run(context_, kPart, &encoder));
  return compressed;
}

void ExrOutput::write(const exr_chunk_info_t& tile, std::span<const std::byte> compressed) {
  check(exr_write_tile_chunk(context_, kPart, tile.start_x, tile.start_y, tile.level_x,
                             tile.level_y, compressed.data(), compressed.size()));
}

void ExrOutput::commit() {
  check(exr_finish(&context_));
  file_.commit();
}

void ExrOutput::write_header(ImageSize size, std::uint32_t tile_texels) {
  int part = kPart;
  check(exr_add_part(context_, "map", EXR_STORAGE_TILED, &part));
  check(exr_initialize_required_attr_simple(context_, kPart, static_cast<std::int32_t>(size.width),
                                            static_cast<std::int32_t>(size.height),
                                            EXR_COMPRESSION_ZIP));
  // Tiles lie in the file as they come.
  check(exr_set_lineorder(context_, kPart, EXR_LINEORDER_RANDOM_Y));
  check(exr_set_tile_descriptor(context_, kPart, tile_texels, tile_texels, EXR_TILE_MIPMAP_LEVELS,
                                EXR_TILE_ROUND_DOWN));
  for (const MapChannel& channel : channels_) {
    check(exr_add_channel(context_, kPart, channel.name.c_str(), exr_type(channel.value),
                          EXR_PERCEPTUALLY_LINEAR, 1, 1));
  }
  check(exr_write_header(context_));
}

/// The library has its channels in the order of their names.
std::size_t ExrOutput::number_of(std::string_view channel) const {
  return static_cast<std::size_t>(std::ranges::find(channels_, channel, &MapChannel::name) -
                                  channels_.begin());
}

/// Throws what a call of the library came to.
void ExrOutput::check(exr_result_t result) {
  if (result == EXR_ERR_SUCCESS) return;
  const std::lock_guard lock(mutex_);
  if (write_error_) std::rethrow_exception(write_error_);
  if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw Error(ErrorKind::kInternal, path(), 0,
              std::string("OpenEXR refuses: ") + exr_get_default_error_message(result));
}

std::int64_t ExrOutput::on_write(exr_const_context_t, void* output, const void* data,
                                 std::uint64_t bytes, std::uint64_t offset,
                                 exr_stream_error_func_ptr_t) {
  return static_cast<ExrOutput*>(output)->write_at(offset, {static_cast<const char*>(data), bytes});
}

std::int64_t ExrOutput::write_at(std::uint64_t offset, std::string_view bytes) noexcept {
  try {
    file_.write_at(offset, bytes);
    return static_cast<std::int64_t>(bytes.size());
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!write_error_) write_error_ = std::current_exception();
    return -1;
  }
}

}  // namespace atlasgauge
