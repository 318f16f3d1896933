#pragma once

#include <cstddef>
#include <memory>

namespace atlasgauge {

/// Memory aligned for direct I/O; in huge pages, where the system has them, if that is asked for
/// and fills one. Direct I/O pins page by page: with huge ones it costs half the CPU, and disks run
/// faster. But their first touch is dear, so they are for memory that is used again and again.
class AlignedBytes {
 public:
  static constexpr std::size_t kAlignment = 4096;
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;

  AlignedBytes() = default;
  enum class Pages { kOrdinary, kHuge };
  explicit AlignedBytes(std::size_t bytes, Pages pages = Pages::kOrdinary);
  std::byte* data() const { return data_.get(); }
  explicit operator bool() const { return data_ != nullptr; }

  static std::size_t rounded_up(std::size_t bytes) {
    return (bytes + kAlignment - 1) / kAlignment * kAlignment;
  }

 private:
  struct Release {
    std::size_t mapped_bytes;  ///< 0: from the allocator
    void operator()(std::byte* p) const;
  };
  std::unique_ptr<std::byte, Release> data_;
};

}  // namespace atlasgauge
