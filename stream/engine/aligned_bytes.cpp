#include "stream/engine/aligned_bytes.hpp"

#include <cstdlib>
#include <new>

namespace atlasgauge {

AlignedBytes::AlignedBytes(std::size_t bytes) {
  data_.reset(static_cast<std::byte*>(std::aligned_alloc(kAlignment, rounded_up(bytes))));
  if (data_ == nullptr) throw std::bad_alloc();
}

void AlignedBytes::Free::operator()(std::byte* p) const {
  std::free(p);
}

}  // namespace atlasgauge
