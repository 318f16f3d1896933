#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stream/engine/spill.hpp"

namespace atlasgauge {

/// Which pages of a table a direct-mapped cache of `sets` pages holds.
class PageTags {
 public:
  explicit PageTags(std::size_t sets) : tags_(std::max<std::size_t>(1, sets), kEmpty) {}

  std::size_t sets() const { return tags_.size(); }
  std::size_t set_of(std::uint32_t page) const { return page % tags_.size(); }
  /// Whether the page was there; afterwards it is.
  bool access(std::uint32_t page) {
    std::uint32_t& tag = tags_[set_of(page)];
    if (tag == page) return true;
    tag = page;
    return false;
  }

 private:
  static constexpr std::uint32_t kEmpty = ~std::uint32_t{0};
  std::vector<std::uint32_t> tags_;
};

/// Pages of a table: a power of two of records that is also a whole number of I/O units. Pages end
/// at block ends.
template <class T>
struct PageLayout {
  /// The smallest page.
  static constexpr std::uint32_t kRecords = sizeof(T) >= 16 ? 512 : 2048;
  static constexpr std::size_t kBytes = kRecords * sizeof(T);
  static_assert(kBytes % Scratch::kAlignment == 0);

  /// Larger pages, of which the memory still holds hundreds: for neighbours that are asked for one
  /// after the other, fewer reads.
  static std::uint32_t records_for_neighbours(std::uint64_t memory_bytes) {
    constexpr std::uint64_t kLeastPages = 256;
    constexpr std::size_t kLargestBytes = 128 << 10;
    std::uint32_t records = kRecords;
    while (sizeof(T) * records * 2 <=
           std::min<std::uint64_t>(kLargestBytes, memory_bytes / kLeastPages)) {
      records *= 2;
    }
    return records;
  }

  explicit PageLayout(const Spill<T>& table, std::uint32_t page_records = kRecords)
      : records_per_block(static_cast<std::uint32_t>(table.records_per_block())),
        shift(static_cast<unsigned>(std::countr_zero(page_records))),
        pages_per_block((records_per_block + page_records - 1) >> shift) {}

  std::uint32_t page_of(std::uint32_t record) const {
    const std::uint32_t block = record / records_per_block;
    return block * pages_per_block + ((record - block * records_per_block) >> shift);
  }
  std::uint32_t in_page(std::uint32_t record) const {
    return record % records_per_block & ((1U << shift) - 1);
  }
  std::size_t page_bytes() const { return sizeof(T) << shift; }

  std::uint32_t records_per_block;
  unsigned shift;  ///< log2 of the records of a page
  std::uint32_t pages_per_block;
};

/// Random reads of a table through a cache of pages, for one thread. Resident blocks are read in
/// place. All pages lie in one allocation: one each would cost a third more, and would stay with
/// the allocator afterwards.
template <class T>
class PageCache {
 public:
  PageCache(const Spill<T>& table, std::uint64_t memory_bytes,
            std::uint32_t page_records = PageLayout<T>::kRecords)
      : table_(&table),
        layout_(table, page_records),
        tags_(memory_bytes / layout_.page_bytes()),
        memory_(tags_.sets() * layout_.page_bytes(), AlignedBytes::Pages::kHuge),
        pages_(tags_.sets(), nullptr) {}

  const T& at(std::uint32_t record) {
    const std::uint32_t page = layout_.page_of(record);
    const std::size_t set = tags_.set_of(page);
    if (!tags_.access(page)) pages_[set] = load(page, set);
    return pages_[set][layout_.in_page(record)];
  }

  /// From disk, so far.
  std::uint64_t read_bytes() const { return read_bytes_; }

 private:
  const T* load(std::uint32_t page, std::size_t set) {
    const Scratch& scratch = *table_->scratch();
    const std::uint32_t block = page / layout_.pages_per_block;
    const std::size_t offset = (page % layout_.pages_per_block) * layout_.page_bytes();
    if (const std::byte* bytes = scratch.resident(table_->block(block))) {
      return reinterpret_cast<const T*>(bytes + offset);
    }
    std::byte* const memory = memory_.data() + set * layout_.page_bytes();
    const std::size_t end =
        std::min(offset + layout_.page_bytes(), table_->records_in_block(block) * sizeof(T));
    scratch.read(table_->block(block), offset, memory, end - offset);
    read_bytes_ += end - offset;
    return reinterpret_cast<const T*>(memory);
  }

  const Spill<T>* table_;
  PageLayout<T> layout_;
  PageTags tags_;
  AlignedBytes memory_;
  std::vector<const T*> pages_;
  std::uint64_t read_bytes_ = 0;
};

}  // namespace atlasgauge
