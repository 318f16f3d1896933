#include "stream/engine/aligned_bytes.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace atlasgauge {
namespace {

std::byte* map(std::size_t bytes) {
  void* const memory =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return static_cast<std::byte*>(memory);
}

void unmap(std::byte* from, std::byte* to) {
  if (from != to) ::munmap(from, static_cast<std::size_t>(to - from));
}

/// Maps more than is needed, and gives back what lies before and after.
std::byte* map_huge(std::size_t bytes) {
  std::byte* const all = map(bytes + AlignedBytes::kHugePage);
  const std::size_t past = reinterpret_cast<std::uintptr_t>(all) % AlignedBytes::kHugePage;
  std::byte* const begin = past == 0 ? all : all + (AlignedBytes::kHugePage - past);
  unmap(all, begin);
  unmap(begin + bytes, all + bytes + AlignedBytes::kHugePage);
  ::madvise(begin, bytes, MADV_HUGEPAGE);
  return begin;
}

}  // namespace

AlignedBytes::AlignedBytes(std::size_t bytes, Pages pages) {
  const std::size_t size = rounded_up(bytes);
  if (pages == Pages::kHuge && size >= kHugePage) {
    data_ = {map_huge(size), Release{size}};
    return;
  }
  data_ = {static_cast<std::byte*>(std::aligned_alloc(kAlignment, size)), Release{}};
  if (data_ == nullptr) throw std::bad_alloc();
}

void AlignedBytes::Release::operator()(std::byte* p) const {
  mapped_bytes > 0 ? unmap(p, p + mapped_bytes) : std::free(p);
}

}  // namespace atlasgauge
