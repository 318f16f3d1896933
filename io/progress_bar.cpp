#include "io/progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

namespace atlasgauge {
namespace {

constexpr int kWidth = 40;

// Nobody is told when standard error takes no more: there is no one left to tell.
void put(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace

void ProgressBar::update(const std::string& stage, double fraction) noexcept {
  if (!shown_) return;
  std::array<char, 256> line{};
  const int filled = static_cast<int>(kWidth * fraction);
  const auto [end, size] =
      fmt::format_to_n(line.data(), line.size(), "\r{:<12} [{:=<{}}{:<{}}] {:3.0f} %", stage, "",
                       filled, "", kWidth - filled, 100 * fraction);
  const std::lock_guard lock(mutex_);
  std::fwrite(line.data(), 1, std::min(size, line.size()), stderr);
  drawn_ = true;
}

void ProgressBar::message(const std::string& text) {
  const std::lock_guard lock(mutex_);
  erase_line();
  put(text + "\n");
}

void ProgressBar::clear() noexcept {
  const std::lock_guard lock(mutex_);
  erase_line();
}

void ProgressBar::erase_line() noexcept {
  if (!drawn_) return;
  std::fprintf(stderr, "\r%70s\r", "");
  drawn_ = false;
}

}  // namespace atlasgauge
