#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "stream/engine/budget.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {

/// Distributes records to buckets that spill, for many writers at once.
///
/// Every writer belongs to one thread and stages some records per bucket, so that the lock of a
/// bucket is taken once for all of them. The order of records in a bucket depends on the
/// threads; whoever needs an order sorts. Memory: one block a bucket, and the staging of each
/// writer.
template <class T>
class Partition {
 public:
  static std::uint64_t memory_bytes(std::size_t buckets, std::size_t writers,
                                    std::size_t block_bytes) {
    return buckets * (block_bytes + writers * staging_bytes(block_bytes));
  }
  /// What a writer stages for a bucket.
  static std::size_t staging_bytes(std::size_t block_bytes) {
    return staged_records(block_bytes) * sizeof(T);
  }

  Partition(Scratch& scratch, std::size_t buckets) : block_bytes_(scratch.block_bytes()) {
    for (std::size_t i = 0; i < buckets; ++i) buckets_.push_back(std::make_unique<Bucket>(scratch));
  }

  std::size_t bucket_count() const { return buckets_.size(); }

  /// The buckets; frees the memory of the partition. All writers have been flushed by then.
  std::vector<Spill<T>> finish() {
    std::vector<Spill<T>> spills;
    for (const auto& bucket : buckets_) spills.push_back(bucket->writer.finish());
    return spills;
  }

  class Writer {
   public:
    explicit Writer(Partition& partition)
        : partition_(&partition),
          most_staged_(staged_records(partition.block_bytes_)),
          staged_(partition.bucket_count() * most_staged_),
          counts_(partition.bucket_count(), 0) {}

    void push(std::size_t bucket, const T& record) {
      staged_[bucket * most_staged_ + counts_[bucket]] = record;
      if (++counts_[bucket] == most_staged_) flush(bucket);
    }

    /// To be called before the partition is read.
    void flush() {
      for (std::size_t bucket = 0; bucket < counts_.size(); ++bucket) flush(bucket);
    }

   private:
    void flush(std::size_t bucket) {
      if (counts_[bucket] == 0) return;
      Bucket& target = *partition_->buckets_[bucket];
      const std::lock_guard lock(target.mutex);
      target.writer.append({&staged_[bucket * most_staged_], std::exchange(counts_[bucket], 0)});
    }

    Partition* partition_;
    std::size_t most_staged_;
    std::vector<T> staged_;
    std::vector<std::uint32_t> counts_;
  };

 private:
  struct Bucket {
    explicit Bucket(Scratch& scratch) : writer(scratch) {}
    std::mutex mutex;
    SpillWriter<T> writer;
  };

  /// More where blocks are large, for fewer locks; little beside the block in any case.
  static std::size_t staged_records(std::size_t block_bytes) {
    const std::size_t bytes = std::clamp<std::size_t>(block_bytes / 4, 1024, 4096);
    return std::max<std::size_t>(4, bytes / sizeof(T));
  }

  const std::size_t block_bytes_;
  std::vector<std::unique_ptr<Bucket>> buckets_;
};

/// One Spill that many threads append to, in no particular order.
template <class T>
class SharedSpill {
 public:
  explicit SharedSpill(Scratch& scratch) : partition_(scratch, 1) {}
  class Writer {
   public:
    explicit Writer(SharedSpill& spill) : writer_(spill.partition_) {}
    void push(const T& record) { writer_.push(0, record); }
    void flush() { writer_.flush(); }

   private:
    typename Partition<T>::Writer writer_;
  };
  /// All writers have been flushed by then.
  Spill<T> finish() { return std::move(partition_.finish().front()); }

 private:
  Partition<T> partition_;
};

}  // namespace atlasgauge
