#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/temp_folder.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {

enum class Room {
  kInMemory,      ///< the records fit, and scratch never touches the disk
  kBeyondMemory,  ///< all of scratch is on disk, and the budget a quarter of the records
};

inline std::string name_of(Room room) {
  return room == Room::kInMemory ? "in_memory" : "beyond_memory";
}

/// What stages are timed with.
inline constexpr std::array<std::size_t, 2> kThreads{1, 2};

/// An engine for about so many bytes of records, with all that it refers to.
class BenchEngine {
 public:
  BenchEngine(Room room, std::uint64_t record_bytes, std::size_t threads)
      : BenchEngine(size_for(room, record_bytes), threads) {}

  const Engine& engine() const { return engine_; }

  /// Whether the records went where they were to go.
  bool kept_to_its_room() const { return (scratch_.spilled_bytes() > 0) == (resident_bytes_ == 0); }

  template <class T>
  Spill<T> spill_of(std::span<const T> records) {
    SpillWriter<T> writer(scratch_);
    writer.append(records);
    return writer.finish();
  }

 private:
  struct Size {
    std::uint64_t budget_bytes, resident_bytes;
    std::size_t block_bytes;
  };

  /// Blocks are in proportion to the budget, as those of the program are.
  static Size size_for(Room room, std::uint64_t record_bytes) {
    constexpr std::uint64_t kLeastBytes = 1 << 20;
    if (room == Room::kInMemory) {
      const std::uint64_t bytes = std::max(64 * kLeastBytes, 6 * record_bytes);
      return {2 * bytes, bytes, 256 << 10};
    }
    const std::uint64_t bytes = std::max(kLeastBytes, record_bytes / 4);
    const std::uint64_t pages = std::clamp<std::uint64_t>(bytes / 256 / Scratch::kAlignment, 1, 64);
    return {bytes, 0, pages * Scratch::kAlignment};
  }

  BenchEngine(const Size& size, std::size_t threads)
      : resident_bytes_(size.resident_bytes),
        budget_(size.budget_bytes),
        scratch_({scratch_directory(), size.block_bytes, size.resident_bytes}, budget_),
        workers_(threads),
        log_(scratch_, workers_) {}

  std::uint64_t resident_bytes_;
  MemoryBudget budget_;
  Scratch scratch_;
  Workers workers_;
  StageLog log_;
  Engine engine_{budget_, scratch_, workers_, log_};
};

}  // namespace atlasgauge
