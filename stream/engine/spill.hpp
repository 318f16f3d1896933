#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "stream/engine/scratch.hpp"

namespace atlasgauge {

/// A sequence of fixed-size records in scratch blocks. Owns its blocks; move-only.
/// Records do not cross blocks: every block but the last holds records_per_block().
template <class T>
class Spill {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Spill() = default;
  explicit Spill(Scratch& scratch) : scratch_(&scratch) {}
  Spill(Spill&& other) noexcept { swap(other); }
  Spill& operator=(Spill&& other) noexcept {
    if (this != &other) clear();
    swap(other);
    return *this;
  }
  ~Spill() { clear(); }

  std::uint64_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t records_per_block() const { return scratch_->block_bytes() / sizeof(T); }
  std::size_t block_count() const { return blocks_.size(); }
  Scratch* scratch() const { return scratch_; }
  Scratch::BlockId block(std::size_t index) const { return blocks_[index]; }
  std::size_t records_in_block(std::size_t index) const {
    const std::uint64_t before = std::uint64_t{index} * records_per_block();
    return static_cast<std::size_t>(std::min<std::uint64_t>(records_per_block(), size_ - before));
  }

  void clear() {
    for (const Scratch::BlockId block : blocks_) {
      if (block != kFreed) scratch_->free(block);
    }
    blocks_.clear();
    size_ = 0;
  }

  /// The records of one block: in place when the block is resident, else read into `buffer`, which
  /// is made when first needed.
  std::span<const T> load(std::size_t index, BlockBuffer& buffer) const {
    const std::size_t count = records_in_block(index);
    std::byte* bytes = scratch_->resident(blocks_[index]);
    if (bytes == nullptr) {
      BlockBytes& memory = buffer.bytes(*scratch_);
      scratch_->load(blocks_[index], memory, count * sizeof(T));
      bytes = memory.data();
    }
    return {reinterpret_cast<const T*>(bytes), count};
  }

  /// Begins to read the blocks [first, first + kAhead) that there are; none of them is freed yet.
  void read_ahead(std::size_t first) const {
    const std::size_t end = std::min(first + kAhead, blocks_.size());
    for (std::size_t i = first; i < end; ++i) {
      scratch_->read_ahead(blocks_[i], records_in_block(i) * sizeof(T));
    }
  }

  void free_block(std::size_t index) { scratch_->free(std::exchange(blocks_[index], kFreed)); }

  /// Takes over a block that holds its full number of records, or any number if it is the last.
  void adopt(Scratch::BlockId block, std::size_t records) {
    blocks_.push_back(block);
    size_ += records;
  }

 private:
  static constexpr std::size_t kAhead = 2;
  static constexpr Scratch::BlockId kFreed = ~Scratch::BlockId{0};

  void swap(Spill& other) noexcept {
    std::swap(scratch_, other.scratch_);
    std::swap(blocks_, other.blocks_);
    std::swap(size_, other.size_);
  }

  Scratch* scratch_ = nullptr;
  std::vector<Scratch::BlockId> blocks_;
  std::uint64_t size_ = 0;
};

/// Appends records to a Spill. Uses at most one block of memory.
template <class T>
class SpillWriter {
 public:
  explicit SpillWriter(Scratch& scratch) : spill_(scratch), scratch_(&scratch) {}
  SpillWriter(SpillWriter&& other) noexcept
      : spill_(std::move(other.spill_)),
        scratch_(other.scratch_),
        buffer_(std::move(other.buffer_)),
        block_(other.block_),
        cursor_(other.cursor_),
        in_block_(std::exchange(other.in_block_, 0)) {}
  SpillWriter& operator=(SpillWriter&& other) = delete;
  ~SpillWriter() {
    if (in_block_ > 0) scratch_->free(block_);
  }

  void push(const T& record) {
    if (in_block_ == 0) open_block();
    std::memcpy(cursor_ + in_block_ * sizeof(T), &record, sizeof(T));
    if (++in_block_ == spill_.records_per_block()) close_block();
  }

  void append(std::span<const T> records) {
    while (!records.empty()) {
      if (in_block_ == 0) open_block();
      const std::size_t room = spill_.records_per_block() - in_block_;
      const std::size_t count = std::min(room, records.size());
      std::memcpy(cursor_ + in_block_ * sizeof(T), records.data(), count * sizeof(T));
      in_block_ += count;
      if (in_block_ == spill_.records_per_block()) close_block();
      records = records.subspan(count);
    }
  }

  std::uint64_t size() const { return spill_.size() + in_block_; }

  /// The records so far; the writer starts over, empty.
  Spill<T> finish() {
    if (in_block_ > 0) close_block();
    buffer_.release();
    return std::exchange(spill_, Spill<T>(*scratch_));
  }

 private:
  void open_block() {
    block_ = scratch_->allocate();
    cursor_ = scratch_->resident(block_);
    if (cursor_ != nullptr) return;
    cursor_ = buffer_.data(*scratch_);
  }

  void close_block() {
    if (scratch_->resident(block_) == nullptr) {
      scratch_->write_behind(block_, buffer_.bytes(*scratch_), in_block_ * sizeof(T));
    }
    spill_.adopt(block_, in_block_);
    in_block_ = 0;
  }

  Spill<T> spill_;
  Scratch* scratch_;
  BlockBuffer buffer_;
  Scratch::BlockId block_ = 0;
  std::byte* cursor_ = nullptr;
  std::size_t in_block_ = 0;
};

/// Reads a Spill from front to back. Uses at most one block of memory. A consuming reader frees
/// each block when it has passed it.
template <class T>
class SpillReader {
 public:
  enum class Mode { kKeep, kConsume };

  explicit SpillReader(const Spill<T>& spill) : spill_(&spill) {}
  SpillReader(Spill<T>& spill, Mode mode)
      : spill_(&spill), consumed_(mode == Mode::kConsume ? &spill : nullptr) {}
  /// From record `first` on; blocks before it may have been freed.
  SpillReader(const Spill<T>& spill, std::uint64_t first)
      : spill_(&spill), next_(static_cast<std::size_t>(first / spill.records_per_block())) {
    const std::uint64_t passed = first % spill.records_per_block();
    if (passed > 0) rest_ = next_block().subspan(passed);
  }

  /// The next records, up to a block of them, valid until the next call; empty at the end.
  std::span<const T> next_block() {
    leave_block();
    if (next_ == spill_->block_count()) return {};
    spill_->read_ahead(next_ + 1);
    return spill_->load(next_++, buffer_);
  }

  /// Fills `to` as far as records last; returns how many.
  std::size_t read(std::span<T> to) {
    std::size_t done = 0;
    while (done < to.size()) {
      if (rest_.empty()) rest_ = next_block();
      if (rest_.empty()) break;
      const std::size_t count = std::min(rest_.size(), to.size() - done);
      std::memcpy(to.data() + done, rest_.data(), count * sizeof(T));
      rest_ = rest_.subspan(count);
      done += count;
    }
    return done;
  }

  bool read(T& record) {
    if (rest_.empty()) rest_ = next_block();
    if (rest_.empty()) return false;
    record = rest_.front();
    rest_ = rest_.subspan(1);
    return true;
  }

 private:
  void leave_block() {
    if (consumed_ != nullptr && next_ > 0 && next_ - 1 < spill_->block_count() && !left_end_) {
      consumed_->free_block(next_ - 1);
      left_end_ = next_ == spill_->block_count();
    }
  }

  const Spill<T>* spill_;
  Spill<T>* consumed_ = nullptr;
  BlockBuffer buffer_;
  std::span<const T> rest_;
  std::size_t next_ = 0;
  bool left_end_ = false;
};

}  // namespace atlasgauge
