#pragma once

#include <openexr.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/unnamed_file.hpp"
#include "io/map/map_channel.hpp"
#include "io/texture/texture_slots.hpp"

namespace atlasgauge {

/// A tiled OpenEXR file with mip levels, through the C interface of OpenEXR: that one compresses
/// tiles on the threads that bring them; the C++ one in threads of its own, or one at a time.
/// compress() and write() are thread-safe. Throws Error(kResource) when the file cannot be written.
class ExrOutput {
 public:
  class Compressed;

  ExrOutput(const std::string& path, ImageSize size, std::uint32_t tile_texels,
            std::span<const MapChannel> channels);
  ~ExrOutput();
  ExrOutput(const ExrOutput&) = delete;
  ExrOutput& operator=(const ExrOutput&) = delete;

  const std::string& path() const { return file_.target(); }

  /// `inside` is how much of the tile is in the image.
  exr_chunk_info_t tile(std::uint32_t level, std::uint32_t x, std::uint32_t y, ImageSize inside);

  /// `texels` are the first ones of the channels; rows lie `row_bytes` apart, which may be 0.
  Compressed compress(const exr_chunk_info_t& tile, std::span<const std::byte* const> texels,
                      std::size_t row_bytes);

  void write(const exr_chunk_info_t& tile, std::span<const std::byte> compressed);

  /// When all tiles are written.
  void commit();

 private:
  void write_header(ImageSize size, std::uint32_t tile_texels);
  std::size_t number_of(std::string_view channel) const;
  void check(exr_result_t result);

  static std::int64_t on_write(exr_const_context_t context, void* output, const void* data,
                               std::uint64_t bytes, std::uint64_t offset,
                               exr_stream_error_func_ptr_t on_error);
  std::int64_t write_at(std::uint64_t offset, std::string_view bytes) noexcept;

  UnnamedFile file_;
  const std::vector<MapChannel> channels_;
  std::mutex mutex_;
  std::exception_ptr write_error_;  ///< no exception may pass through the library
  exr_context_t context_ = nullptr;
};

class ExrOutput::Compressed {
 public:
  /// The tile as it was, unless it became shorter. Readers expect that; OpenEXR before 3.4.8 does
  /// not when both are of one length (its issue 2306).
  std::span<const std::byte> bytes() const {
    const bool shorter = encoder_->compressed_bytes < encoder_->packed_bytes;
    const void* const data = shorter ? encoder_->compressed_buffer : encoder_->packed_buffer;
    return {static_cast<const std::byte*>(data),
            shorter ? encoder_->compressed_bytes : encoder_->packed_bytes};
  }

 private:
  friend class ExrOutput;
  struct End {
    void operator()(exr_encode_pipeline_t* encoder) const {
      if (encoder->context != nullptr) exr_encoding_destroy(encoder->context, encoder);
      delete encoder;
    }
  };
  std::unique_ptr<exr_encode_pipeline_t, End> encoder_{new exr_encode_pipeline_t{}};
};

}  // namespace atlasgauge
