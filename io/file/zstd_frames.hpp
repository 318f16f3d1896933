#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace atlasgauge {

/// Follows the frames of a zstd stream (RFC 8878 section 3) from header to header, without
/// decompressing, to know whether a stream ends where a frame does: the decompressor of
/// Boost.Iostreams takes a stream that is cut off for one that has ended.
class ZstdFrames {
 public:
  /// True for the first four bytes of a zstd frame, or of one to be skipped.
  static bool is_magic(std::string_view bytes);

  void add(std::string_view bytes);

  /// True at the end of a frame, and before the first.
  bool complete() const { return part_ == Part::kMagic && have_ == 0 && skipped_ == 0; }

 private:
  enum class Part { kMagic, kSkipSize, kDescriptor, kBlockHeader, kUnknown };
  static constexpr std::uint64_t kMagicBytes = 4;

  void take_field();
  void take_magic();
  void take_descriptor();
  void take_block_header();
  void expect(Part part, std::uint64_t bytes);

  Part part_ = Part::kMagic;
  std::uint64_t needed_ = kMagicBytes;  // bytes of the field
  std::uint64_t have_ = 0;              // of these, seen
  std::uint64_t field_ = 0;             // little-endian
  std::uint64_t skipped_ = 0;           // bytes before the field to pass over
  bool has_checksum_ = false;
};

}  // namespace atlasgauge
