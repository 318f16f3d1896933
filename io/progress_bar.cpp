#include "io/progress_bar.hpp"

#include <fmt/format.h>

namespace atlasgauge {

void ProgressBar::update(const std::string& stage, double fraction) {
  if (!shown_) return;
  constexpr int kWidth = 40;
  const int filled = static_cast<int>(kWidth * fraction);
  const std::lock_guard lock(mutex_);
  fmt::print(stderr, "\r{:<12} [{:=<{}}{:<{}}] {:3.0f} %", stage, "", filled, "", kWidth - filled,
             100 * fraction);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::message(const std::string& text) {
  const std::lock_guard lock(mutex_);
  erase_line();
  fmt::print(stderr, "{}\n", text);
}

void ProgressBar::clear() {
  const std::lock_guard lock(mutex_);
  erase_line();
}

void ProgressBar::erase_line() {
  if (!drawn_) return;
  fmt::print(stderr, "\r{:70}\r", "");
  drawn_ = false;
}

}  // namespace atlasgauge
