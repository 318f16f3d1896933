#pragma once

#include <cstdint>

namespace atlasgauge {

/// While one lives, `operator new` of its thread throws std::bad_alloc where what the thread
/// allocated since, less what it freed, would be more than `bytes`. For libraries that believe
/// numbers in hostile files; one a thread at a time.
class AllocationLimit {
 public:
  explicit AllocationLimit(std::uint64_t bytes);
  ~AllocationLimit();
  AllocationLimit(const AllocationLimit&) = delete;
  AllocationLimit& operator=(const AllocationLimit&) = delete;

  /// Whether an allocation was refused.
  bool was_reached() const;
};

}  // namespace atlasgauge
