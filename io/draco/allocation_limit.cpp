#include "io/draco/allocation_limit.hpp"

#include <malloc.h>

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace atlasgauge {
namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

/// What operator new may still allocate on this thread. Functions that replace the global ones can
/// be handed nothing, so this has to live beside them.
struct Room {
  std::int64_t bytes = kNoLimit;
  bool was_reached = false;
};
thread_local constinit Room room;

bool is_limited() {
  return room.bytes != kNoLimit;
}

void* allocate(std::size_t bytes) noexcept {
  if (is_limited()) [[unlikely]] {
    if (static_cast<std::int64_t>(bytes) > room.bytes || static_cast<std::int64_t>(bytes) < 0) {
      room.was_reached = true;
      return nullptr;
    }
  }
  void* const memory = std::malloc(bytes == 0 ? 1 : bytes);
  if (is_limited() && memory != nullptr) [[unlikely]] {
    room.bytes -= static_cast<std::int64_t>(::malloc_usable_size(memory));
  }
  return memory;
}

void release(void* memory) noexcept {
  if (is_limited() && memory != nullptr) [[unlikely]] {
    room.bytes += static_cast<std::int64_t>(::malloc_usable_size(memory));
  }
  std::free(memory);
}

void* allocate_or_throw(std::size_t bytes) {
  void* const memory = allocate(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

AllocationLimit::AllocationLimit(std::uint64_t bytes) {
  room = {static_cast<std::int64_t>(bytes), false};
}

AllocationLimit::~AllocationLimit() {
  room = {};
}

bool AllocationLimit::was_reached() const {
  return room.was_reached;
}

}  // namespace atlasgauge

// All forms but those for overaligned types, so that a sanitizer finds no mixture of its own and
// these.
void* operator new(std::size_t bytes) {
  return atlasgauge::allocate_or_throw(bytes);
}
void* operator new[](std::size_t bytes) {
  return atlasgauge::allocate_or_throw(bytes);
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return atlasgauge::allocate(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return atlasgauge::allocate(bytes);
}
void operator delete(void* memory) noexcept {
  atlasgauge::release(memory);
}
void operator delete[](void* memory) noexcept {
  atlasgauge::release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  atlasgauge::release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  atlasgauge::release(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  atlasgauge::release(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  atlasgauge::release(memory);
}
