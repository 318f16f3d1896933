#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "stream/engine/aligned_bytes.hpp"

namespace atlasgauge {

/// Memory for records that are all written before they are read: a vector would set them to zero
/// first, and lies in small pages, over which records are scattered slowly.
template <class T>
class RecordBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Loses what it held; never has the old and the new memory at once.
  void resize(std::size_t records) {
    if (capacity_ < records) {
      capacity_ = 0;
      memory_ = AlignedBytes();
      memory_ = AlignedBytes(records * sizeof(T), AlignedBytes::Pages::kHuge);
      capacity_ = records;
    }
    size_ = records;
  }

  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  std::span<T> all() { return {data(), size_}; }

 private:
  T* data() { return reinterpret_cast<T*>(memory_.data()); }

  AlignedBytes memory_;
  std::size_t capacity_ = 0;
  std::size_t size_ = 0;
};

}  // namespace atlasgauge
