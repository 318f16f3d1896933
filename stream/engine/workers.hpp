#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace atlasgauge {

/// The whole parallel vocabulary: a fixed number of workers, this thread being one of them.
///
/// A pipeline has three steps per item. `produce` and `commit` run one at a time and in the order
/// of the items, so they may read and write files and shared state without locks; `transform` runs
/// on all workers at once and owns only what belongs to its worker. At most one item a worker is
/// under way, so memory is bounded by construction. An exception of any step stops all and is
/// thrown here.
class Workers {
 public:
  explicit Workers(std::size_t count)
      : count_(count == 0 ? 1 : count), items_done_(std::make_unique<Counter[]>(count_)) {}
  std::size_t count() const { return count_; }
  /// Items that a worker has transformed so far.
  std::uint64_t items_done(std::size_t worker) const { return items_done_[worker]; }

  struct Pipeline {
    std::function<bool(std::size_t worker)> produce;  ///< false: no more items
    std::function<void(std::size_t worker)> transform;
    std::function<void(std::size_t worker)> commit;  ///< may be empty
  };
  void run(const Pipeline& pipeline) const;

  /// Calls work(worker, index) for every index below `items`, in any order.
  void for_each(std::size_t items,
                const std::function<void(std::size_t worker, std::size_t item)>& work) const;

 private:
  using Counter = std::atomic<std::uint64_t>;

  std::size_t count_;
  std::unique_ptr<Counter[]> items_done_;
};

}  // namespace atlasgauge
