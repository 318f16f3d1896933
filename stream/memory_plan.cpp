#include "stream/memory_plan.hpp"

#include <algorithm>
#include <bit>

#include "io/bytes.hpp"
#include "io/error.hpp"
#include "io/memory_limit.hpp"
#include "stream/engine/scratch.hpp"
#include "stream/raster/osmesa_raster.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;
constexpr std::uint64_t kFloorBytes = 256 * kMiB;
constexpr std::uint64_t kOsmesaFloorBytes = 448 * kMiB;
/// Resident once the image library is loaded, as measured, and the program itself.
constexpr std::uint64_t kProcessBytes = 152 * kMiB;
/// Stacks, allocator slack and small objects of a worker.
constexpr std::uint64_t kWorkerBytes = 2 * kMiB;
/// Buckets beyond the caches make sorting slower, so a larger engine would not be faster.
constexpr std::uint64_t kLargestEngineBytes = 1024 * kMiB;
constexpr std::uint64_t kSmallestEngineBytes = 2 * kMiB;
constexpr std::uint64_t kSmallestBlockBytes = 4096;
constexpr std::uint64_t kLargestBlockBytes = 1 * kMiB;
/// Blocks that the engine's memory holds: enough for the buckets of one distribution, and for
/// labels of as many faces as an index can number.
constexpr std::uint64_t kBlocksPerEngine = 512;
/// Blocks on their way to and from disk, at most, and the share of the engine that they may take.
constexpr std::uint64_t kQueuedBlocksPerWorker = 8;
constexpr std::uint64_t kMostQueuedBlocks = 64;
constexpr std::uint64_t kQueueShare = 16;
/// The least share of a thread when their number is not given.
constexpr std::uint64_t kEngineBytesPerThread = 8 * kMiB;

/// What is no concern of the engine.
struct OtherNeeds {
  explicit OtherNeeds(bool osmesa)
      : floor_bytes(osmesa ? kOsmesaFloorBytes : kFloorBytes),
        process_bytes(kProcessBytes + (osmesa ? kOsmesaLoadedBytes : 0)),
        worker_bytes(kWorkerBytes +
                     (osmesa ? osmesa_raster_bytes(kUsualOsmesaTile, kUsualOsmesaTile) : 0)) {}
  std::uint64_t floor_bytes, process_bytes, worker_bytes;
};

std::uint64_t engine_share(const MemoryPlan& plan, const OtherNeeds& other) {
  const std::string limit =
      "a memory limit of " + format_bytes(plan.limit_bytes) + " (" + plan.origin + ")";
  if (plan.limit_bytes < other.floor_bytes) {
    throw Error(ErrorKind::kResource, limit + " is too little; give at least " +
                                          format_bytes(other.floor_bytes) + " with --memory");
  }
  const std::uint64_t process_bytes = other.process_bytes + plan.workers * other.worker_bytes;
  if (process_bytes + kSmallestEngineBytes > plan.limit_bytes) {
    throw Error(ErrorKind::kResource, limit + " is too little for " + std::to_string(plan.workers) +
                                          " threads; give fewer with --threads, or at least " +
                                          format_bytes(process_bytes + 64 * kMiB) +
                                          " with --memory");
  }
  return std::min(kLargestEngineBytes, plan.limit_bytes - process_bytes);
}

std::size_t choose_threads(const MemoryWishes& wishes, std::uint64_t limit_bytes,
                           const OtherNeeds& other, std::size_t cpus) {
  if (wishes.threads > 0) return wishes.threads;
  const std::uint64_t rest_bytes = limit_bytes - std::min(limit_bytes, other.process_bytes);
  const std::uint64_t affordable = rest_bytes / (kEngineBytesPerThread + other.worker_bytes);
  return std::clamp<std::size_t>(affordable, 1, std::max<std::size_t>(1, cpus));
}

}  // namespace

MemoryPlan plan_memory(const MemoryWishes& wishes, std::size_t cpus) {
  MemoryPlan plan;
  if (wishes.limit_bytes) {
    plan.limit_bytes = *wishes.limit_bytes;
    plan.origin = "--memory";
  } else {
    const MemoryLimit limit = detect_memory_limit();
    plan.limit_bytes = limit.bytes / 10 * 8;
    plan.origin = "0.8 of " + limit.origin;
  }
  const OtherNeeds other(wishes.osmesa);
  plan.workers = choose_threads(wishes, plan.limit_bytes, other, cpus);
  plan.engine_bytes = wishes.engine_bytes ? *wishes.engine_bytes : engine_share(plan, other);
  if (plan.engine_bytes < kSmallestEngineBytes) {
    throw Error(ErrorKind::kResource, "--engine-memory is too little; give at least " +
                                          format_bytes(kSmallestEngineBytes));
  }
  const std::uint64_t taken_bytes =
      other.process_bytes + plan.workers * other.worker_bytes + plan.engine_bytes;
  plan.spare_bytes = plan.limit_bytes - std::min(plan.limit_bytes, taken_bytes);
  plan.resident_bytes = plan.engine_bytes / 4;
  plan.block_bytes = std::clamp(std::bit_floor(plan.engine_bytes / kBlocksPerEngine),
                                kSmallestBlockBytes, kLargestBlockBytes);
  if (wishes.block_bytes) plan.block_bytes = *wishes.block_bytes;
  if (plan.block_bytes < kSmallestBlockBytes || plan.block_bytes % Scratch::kAlignment != 0) {
    throw Error(ErrorKind::kUsage, "--block-bytes must be a multiple of 4096");
  }
  plan.queued_blocks = std::min({kQueuedBlocksPerWorker * plan.workers, kMostQueuedBlocks,
                                 plan.engine_bytes / kQueueShare / plan.block_bytes});
  return plan;
}

}  // namespace atlasgauge
