#include "stream/engine/workers.hpp"

#include <fmt/format.h>

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// State of one run. Items get their number when they are produced; commit waits for its turn.
class PipelineRun {
 public:
  explicit PipelineRun(const Workers::Pipeline& pipeline) : pipeline_(pipeline) {}

  /// Counts the items that this worker transforms in `done`.
  void work(std::size_t worker, std::atomic<std::uint64_t>& done) {
    try {
      for (std::uint64_t item = 0; produce(worker, item);) {
        pipeline_.transform(worker);
        done.fetch_add(1, std::memory_order_relaxed);
        if (pipeline_.commit && !commit(worker, item)) return;
      }
    } catch (...) {
      fail(std::current_exception());
    }
  }

  void fail(std::exception_ptr error) {
    const std::lock_guard lock(turn_mutex_);
    if (!error_) error_ = std::move(error);
    turn_changed_.notify_all();
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  bool produce(std::size_t worker, std::uint64_t& item) {
    const std::lock_guard lock(produce_mutex_);
    if (stopped() || exhausted_) return false;
    exhausted_ = !pipeline_.produce(worker);
    item = produced_;
    if (!exhausted_) ++produced_;
    return !exhausted_;
  }

  bool commit(std::size_t worker, std::uint64_t item) {
    std::unique_lock lock(turn_mutex_);
    turn_changed_.wait(lock, [&] { return error_ != nullptr || turn_ == item; });
    if (error_) return false;
    lock.unlock();
    pipeline_.commit(worker);
    lock.lock();
    ++turn_;
    turn_changed_.notify_all();
    return true;
  }

  bool stopped() {
    const std::lock_guard lock(turn_mutex_);
    return error_ != nullptr;
  }

  const Workers::Pipeline& pipeline_;
  std::mutex produce_mutex_;
  bool exhausted_ = false;
  std::uint64_t produced_ = 0;

  std::mutex turn_mutex_;
  std::condition_variable turn_changed_;
  std::uint64_t turn_ = 0;
  std::exception_ptr error_;
};

}  // namespace

void Workers::run(const Pipeline& pipeline) const {
  PipelineRun run(pipeline);
  {
    std::vector<std::jthread> others;
    try {
      for (std::size_t worker = 1; worker < count_; ++worker) {
        others.emplace_back([&run, worker, this] { run.work(worker, items_done_[worker]); });
      }
    } catch (const std::system_error& error) {
      run.fail(std::make_exception_ptr(
          Error(ErrorKind::kResource,
                fmt::format("the system gives no thread {} of {}: {}; give fewer with --threads",
                            others.size() + 2, count_, error.code().message()))));
    } catch (...) {
      run.fail(std::current_exception());
    }
    run.work(0, items_done_[0]);
  }
  run.rethrow();
}

void Workers::for_each(
    std::size_t items,
    const std::function<void(std::size_t worker, std::size_t item)>& work) const {
  std::size_t next = 0;
  std::vector<std::size_t> item_of(count_);
  Pipeline pipeline;
  pipeline.produce = [&](std::size_t worker) {
    if (next == items) return false;
    item_of[worker] = next++;
    return true;
  };
  pipeline.transform = [&](std::size_t worker) { work(worker, item_of[worker]); };
  run(pipeline);
}

}  // namespace atlasgauge
