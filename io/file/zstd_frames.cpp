#include "io/file/zstd_frames.hpp"

#include <algorithm>
#include <array>

namespace atlasgauge {
namespace {

constexpr std::uint64_t kFrameMagic = 0xFD2FB528;
constexpr std::uint64_t kSkippableMagic = 0x184D2A50;  // and the 15 after it
constexpr std::uint64_t kBlockHeaderBytes = 3;

bool is_frame(std::uint64_t magic) {
  return magic == kFrameMagic;
}
bool is_skippable(std::uint64_t magic) {
  return (magic & ~std::uint64_t{15}) == kSkippableMagic;
}

}  // namespace

bool ZstdFrames::is_magic(std::string_view bytes) {
  if (bytes.size() < kMagicBytes) return false;
  std::uint64_t magic = 0;
  for (std::size_t i = 0; i < kMagicBytes; ++i) {
    magic |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  }
  return is_frame(magic) || is_skippable(magic);
}

void ZstdFrames::add(std::string_view bytes) {
  while (!bytes.empty() && part_ != Part::kUnknown) {
    const std::uint64_t skipped = std::min<std::uint64_t>(skipped_, bytes.size());
    skipped_ -= skipped;
    bytes.remove_prefix(static_cast<std::size_t>(skipped));
    if (bytes.empty()) return;
    field_ |= std::uint64_t{static_cast<unsigned char>(bytes.front())} << (8 * have_);
    bytes.remove_prefix(1);
    if (++have_ == needed_) take_field();
  }
}

void ZstdFrames::take_field() {
  switch (part_) {
    case Part::kMagic:
      return take_magic();
    case Part::kSkipSize:
      skipped_ = field_;
      return expect(Part::kMagic, kMagicBytes);
    case Part::kDescriptor:
      return take_descriptor();
    case Part::kBlockHeader:
      return take_block_header();
    case Part::kUnknown:
      return;
  }
}

void ZstdFrames::take_magic() {
  if (is_frame(field_)) return expect(Part::kDescriptor, 1);
  if (is_skippable(field_)) return expect(Part::kSkipSize, 4);
  part_ = Part::kUnknown;
}

/// Window descriptor, dictionary id and content size follow, if the bits say so.
void ZstdFrames::take_descriptor() {
  constexpr std::array<std::uint64_t, 4> kDictionaryBytes = {0, 1, 2, 4};
  constexpr std::array<std::uint64_t, 4> kContentBytes = {0, 2, 4, 8};
  const std::uint64_t content_flag = field_ >> 6;
  const bool single_segment = (field_ >> 5 & 1) != 0;
  has_checksum_ = (field_ >> 2 & 1) != 0;
  skipped_ = single_segment ? 0 : 1;
  skipped_ += kDictionaryBytes[field_ & 3] + kContentBytes[content_flag];
  if (single_segment && content_flag == 0) skipped_ += 1;
  expect(Part::kBlockHeader, kBlockHeaderBytes);
}

void ZstdFrames::take_block_header() {
  constexpr std::uint64_t kRunLengthBlock = 1;
  const bool is_last = (field_ & 1) != 0;
  const std::uint64_t type = field_ >> 1 & 3;
  skipped_ = type == kRunLengthBlock ? 1 : field_ >> 3;
  if (!is_last) return expect(Part::kBlockHeader, kBlockHeaderBytes);
  skipped_ += has_checksum_ ? 4 : 0;
  expect(Part::kMagic, kMagicBytes);
}

void ZstdFrames::expect(Part part, std::uint64_t bytes) {
  part_ = part;
  needed_ = bytes;
  have_ = 0;
  field_ = 0;
}

}  // namespace atlasgauge
