#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace atlasgauge {

/// An array that is allocated once and never grows. Its elements start uninitialized, so memory
/// that is never used never becomes resident.
template <class T>
class FixedArray {
 public:
  void allocate(std::size_t capacity) {
    if (capacity != capacity_) {
      items_ = std::make_unique_for_overwrite<T[]>(capacity);
      capacity_ = capacity;
    }
    size_ = 0;
  }

  void push(const T& item) { items_[size_++] = item; }
  void resize(std::size_t size) { size_ = size; }

  bool full() const { return size_ == capacity_; }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  T* data() { return items_.get(); }
  const T* data() const { return items_.get(); }
  T& operator[](std::size_t index) { return items_[index]; }
  const T& operator[](std::size_t index) const { return items_[index]; }
  std::span<const T> items() const { return {items_.get(), size_}; }

 private:
  std::unique_ptr<T[]> items_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace atlasgauge
