#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>

namespace atlasgauge {

/// A fixed number of chunks of memory, each of a few records, which form lists. Taking chunks and
/// giving them back is thread-safe; a list belongs to one thread at a time.
template <class Record>
class ChunkPool {
 public:
  using ChunkId = std::uint32_t;
  static constexpr ChunkId kNoChunk = ~ChunkId{0};
  static constexpr std::uint32_t kRecords = 32;
  static constexpr std::uint64_t kChunkBytes = kRecords * sizeof(Record) + sizeof(ChunkId);

  /// Memory that is never used is never touched.
  explicit ChunkPool(std::uint64_t memory_bytes)
      : chunks_(
            static_cast<ChunkId>(std::min<std::uint64_t>(memory_bytes / kChunkBytes, kNoChunk))),
        records_(std::make_unique_for_overwrite<Record[]>(std::size_t{chunks_} * kRecords)),
        next_(std::make_unique_for_overwrite<ChunkId[]>(chunks_)) {}

  ChunkId chunks() const { return chunks_; }
  ChunkId free_chunks() const {
    const std::lock_guard lock(mutex_);
    return free_chunks_ + chunks_ - fresh_;
  }

  /// A chunk that `next` follows; kNoChunk when all are in use.
  ChunkId take(ChunkId next) {
    const ChunkId chunk = take_any();
    if (chunk != kNoChunk) next_[chunk] = next;
    return chunk;
  }

  ChunkId next(ChunkId chunk) const { return next_[chunk]; }
  std::span<Record> records(ChunkId chunk) {
    return {&records_[std::size_t{chunk} * kRecords], kRecords};
  }

  /// The whole list from `first` on.
  void give_back(ChunkId first) {
    if (first == kNoChunk) return;
    ChunkId count = 1;
    ChunkId last = first;
    for (; next_[last] != kNoChunk; last = next_[last]) ++count;
    const std::lock_guard lock(mutex_);
    next_[last] = first_free_;
    first_free_ = first;
    free_chunks_ += count;
  }

 private:
  ChunkId take_any() {
    const std::lock_guard lock(mutex_);
    if (first_free_ == kNoChunk) return fresh_ < chunks_ ? fresh_++ : kNoChunk;
    --free_chunks_;
    const ChunkId chunk = first_free_;
    first_free_ = next_[chunk];
    return chunk;
  }

  const ChunkId chunks_;
  std::unique_ptr<Record[]> records_;
  std::unique_ptr<ChunkId[]> next_;
  mutable std::mutex mutex_;
  ChunkId first_free_ = kNoChunk;
  ChunkId free_chunks_ = 0;
  ChunkId fresh_ = 0;  // chunks from here on have never been used
};

}  // namespace atlasgauge
