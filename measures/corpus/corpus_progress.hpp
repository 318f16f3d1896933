#pragma once

#include <cstddef>
#include <string>

#include "io/progress_bar.hpp"

namespace atlasgauge {

/// What a command over many models says on standard error: a bar over all of them on a terminal,
/// else a plain line for each.
class CorpusProgress {
 public:
  CorpusProgress(ProgressMode mode, bool quiet);

  /// A model is done, the `done`th of `total`; `line` says what became of it.
  void model(const std::string& line, std::size_t done, std::size_t total);
  /// The bar alone.
  void show(std::size_t done, std::size_t total);
  void message(const std::string& text) { bar_.message(text); }
  void clear() noexcept { bar_.clear(); }

 private:
  const bool has_bar_;
  const bool quiet_;
  ProgressBar bar_;
};

}  // namespace atlasgauge
