#pragma once

#include <cstdio>
#include <mutex>
#include <string>

namespace atlasgauge {

/// One line on standard error that shows how far a stage is, rewritten in place. Other messages go
/// through message(), so that they do not land in the bar. Thread-safe.
class ProgressBar {
 public:
  explicit ProgressBar(bool shown) : shown_(shown) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(const std::string& stage, double fraction);
  void message(const std::string& text);
  void clear();

 private:
  void erase_line();

  const bool shown_;
  bool drawn_ = false;
  std::mutex mutex_;
};

}  // namespace atlasgauge
