#include "measures/corpus/corpus_progress.hpp"

#include <fmt/format.h>

namespace atlasgauge {

CorpusProgress::CorpusProgress(ProgressMode mode, bool quiet)
    : has_bar_(!quiet && shows_progress(mode)), quiet_(quiet), bar_(has_bar_) {}

void CorpusProgress::model(const std::string& line, std::size_t done, std::size_t total) {
  if (!has_bar_ && !quiet_) bar_.message(fmt::format("[{}/{}] {}", done, total, line));
  show(done, total);
}

void CorpusProgress::show(std::size_t done, std::size_t total) {
  bar_.update(fmt::format("{} of {}", done, total),
              static_cast<double>(done) / static_cast<double>(total));
}

}  // namespace atlasgauge
