#pragma once

#include <cstdint>
#include <mutex>
#include <string_view>

namespace atlasgauge {

class MemoryBudget;

/// A claim on the budget; gives it back when it dies.
class Reservation {
 public:
  Reservation() = default;
  Reservation(Reservation&& other) noexcept;
  Reservation& operator=(Reservation&& other) noexcept;
  ~Reservation() { release(); }

  std::uint64_t bytes() const { return bytes_; }
  void release();

 private:
  friend class MemoryBudget;
  Reservation(MemoryBudget& budget, std::uint64_t bytes) : budget_(&budget), bytes_(bytes) {}

  MemoryBudget* budget_ = nullptr;
  std::uint64_t bytes_ = 0;
};

/// The one account of the memory that grows with the input or with a plan made for it. Whoever
/// allocates such memory holds a reservation for it; small fixed objects are not counted.
/// Thread-safe.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t limit_bytes) : limit_bytes_(limit_bytes) {}

  /// Throws Error(kResource) that says who asked and what limit would do.
  Reservation reserve(std::uint64_t bytes, std::string_view who);
  /// As much as is free, but at most `most` and not less than `least`.
  Reservation reserve_between(std::uint64_t least, std::uint64_t most, std::string_view who);

  std::uint64_t limit_bytes() const { return limit_bytes_; }
  std::uint64_t free_bytes() const;
  std::uint64_t peak_bytes() const;

 private:
  friend class Reservation;
  void give_back(std::uint64_t bytes);

  const std::uint64_t limit_bytes_;
  mutable std::mutex mutex_;
  std::uint64_t used_bytes_ = 0;
  std::uint64_t peak_bytes_ = 0;
};

}  // namespace atlasgauge
