#pragma once

#include <mutex>
#include <string>

namespace atlasgauge {

enum class ProgressMode { kAuto, kAlways, kNever };

/// Whether a bar is wanted: as said, or where standard error is a terminal.
bool shows_progress(ProgressMode mode);

/// One line on standard error that shows how far a stage is, rewritten in place. Other messages go
/// through message(), so that they do not land in the bar. Nothing fails when standard error does.
/// Thread-safe.
class ProgressBar {
 public:
  explicit ProgressBar(bool shown) : shown_(shown) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(const std::string& stage, double fraction) noexcept;
  void message(const std::string& text);
  void clear() noexcept;

 private:
  void erase_line() noexcept;

  const bool shown_;
  bool drawn_ = false;
  std::mutex mutex_;
};

}  // namespace atlasgauge
