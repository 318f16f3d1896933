#include "stream/engine/budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

Reservation::Reservation(Reservation&& other) noexcept
    : budget_(std::exchange(other.budget_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

Reservation& Reservation::operator=(Reservation&& other) noexcept {
  if (this == &other) return *this;
  release();
  budget_ = std::exchange(other.budget_, nullptr);
  bytes_ = std::exchange(other.bytes_, 0);
  return *this;
}

void Reservation::release() {
  if (budget_ != nullptr) budget_->give_back(bytes_);
  budget_ = nullptr;
  bytes_ = 0;
}

Reservation MemoryBudget::reserve(std::uint64_t bytes, std::string_view who) {
  return reserve_between(bytes, bytes, who);
}

Reservation MemoryBudget::reserve_between(std::uint64_t least, std::uint64_t most,
                                          std::string_view who) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t free = limit_bytes_ - used_bytes_;
  if (free < least) {
    throw Error(ErrorKind::kResource,
                fmt::format("{} needs {} KiB of working memory, but {} of {} KiB are in use; "
                            "raise --memory by at least {} MiB",
                            who, least >> 10, used_bytes_ >> 10, limit_bytes_ >> 10,
                            ((least - free) >> 20) + 1));
  }
  const std::uint64_t bytes = std::min(free, std::max(least, most));
  used_bytes_ += bytes;
  peak_bytes_ = std::max(peak_bytes_, used_bytes_);
  return Reservation(*this, bytes);
}

std::uint64_t MemoryBudget::free_bytes() const {
  const std::lock_guard lock(mutex_);
  return limit_bytes_ - used_bytes_;
}

std::uint64_t MemoryBudget::peak_bytes() const {
  const std::lock_guard lock(mutex_);
  return peak_bytes_;
}

void MemoryBudget::give_back(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  used_bytes_ -= bytes;
}

}  // namespace atlasgauge
