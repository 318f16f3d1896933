#include "measures/corpus/probe_pool.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include "io/process/child_processes.hpp"
#include "io/process/stop_signals.hpp"
#include "measures/corpus/model_digests.hpp"

namespace atlasgauge {
namespace {

/// So many models share the start of a process and of the image library.
constexpr std::size_t kModelsPerChild = 32;

class ProbePool {
 public:
  ProbePool(const ProbeWork& work, const std::function<void(const ModelProbe&)>& take)
      : work_(work), take_(take), children_(stop_) {
    for (std::size_t first = 0; first < work.models.size(); first += kModelsPerChild) {
      waiting_.push_back({first, std::min(first + kModelsPerChild, work.models.size())});
    }
  }

  int run() {
    while (!waiting_.empty() || children_.running() > 0) {
      while (!waiting_.empty() && children_.running() < work_.jobs) start_next();
      const std::optional<ChildEnd> end = children_.wait();
      if (!end) return stop_.taken();
      settle(*end);
      hand_out();
    }
    return 0;
  }

 private:
  /// Models [first, end).
  struct Batch {
    std::size_t first, end;
  };

  void start_next() {
    const Batch batch = waiting_.front();
    waiting_.pop_front();
    const std::vector<std::string> models(at(batch.first), at(batch.end));
    children_.start(batch.first, probe_command(work_.settings, models, false));
    ends_[batch.first] = batch.end;
  }

  std::vector<std::string>::const_iterator at(std::size_t model) const {
    return work_.models.begin() + static_cast<std::ptrdiff_t>(model);
  }

  /// What a child did not come to goes to another, but for the model that it ended at.
  void settle(const ChildEnd& child) {
    std::size_t next = child.tag;
    const std::size_t end = std::exchange(ends_[child.tag], 0);
    for (ModelProbe& probe : read_probes(child.out)) done_[next++] = std::move(probe);
    if (next >= end) return;
    const std::string& model = work_.models[next];
    done_[next] = {model, 0, digest_from_outside(work_.settings.root, model)};
    if (next + 1 < end) waiting_.push_front({next + 1, end});
  }

  void hand_out() {
    while (!done_.empty() && done_.begin()->first == handed_out_) {
      take_(done_.begin()->second);
      done_.erase(done_.begin());
      ++handed_out_;
    }
  }

  const ProbeWork& work_;
  const std::function<void(const ModelProbe&)>& take_;
  StopSignals stop_;
  ChildProcesses children_;
  std::deque<Batch> waiting_;
  std::map<std::size_t, std::size_t> ends_;  ///< of the batches that children have, by their first
  std::map<std::size_t, ModelProbe> done_;   ///< but for those handed out
  std::size_t handed_out_ = 0;
};

}  // namespace

int probe_models(const ProbeWork& work, const std::function<void(const ModelProbe&)>& take) {
  return ProbePool(work, take).run();
}

}  // namespace atlasgauge
