#include "io/progress_bar.hpp"

#include <unistd.h>

#include <cstdio>

namespace atlasgauge {
namespace {

constexpr char kBar[] = "========================================";
constexpr int kWidth = sizeof(kBar) - 1;

// Nobody is told when standard error takes no more: there is no one left to tell.
void put(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace

bool shows_progress(ProgressMode mode) {
  return mode == ProgressMode::kAlways ||
         (mode == ProgressMode::kAuto && ::isatty(STDERR_FILENO) == 1);
}

void ProgressBar::update(const std::string& stage, double fraction) noexcept {
  if (!shown_) return;
  const int filled = static_cast<int>(kWidth * fraction);
  const std::lock_guard lock(mutex_);
  std::fprintf(stderr, "\r%-12s [%.*s%*s] %3.0f %%", stage.c_str(), filled, kBar, kWidth - filled,
               "", 100 * fraction);
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
