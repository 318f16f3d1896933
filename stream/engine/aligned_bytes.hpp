#pragma once

#include <cstddef>
#include <memory>

namespace atlasgauge {

/// Memory aligned for direct I/O.
class AlignedBytes {
 public:
  static constexpr std::size_t kAlignment = 4096;

  AlignedBytes() = default;
  explicit AlignedBytes(std::size_t bytes);
  std::byte* data() const { return data_.get(); }
  explicit operator bool() const { return data_ != nullptr; }

  static std::size_t rounded_up(std::size_t bytes) {
    return (bytes + kAlignment - 1) / kAlignment * kAlignment;
  }

 private:
  struct Free {
    void operator()(std::byte* p) const;
  };
  std::unique_ptr<std::byte, Free> data_;
};

}  // namespace atlasgauge
