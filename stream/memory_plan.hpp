#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace atlasgauge {

/// How the memory limit of the process is split.
struct MemoryPlan {
  std::uint64_t limit_bytes = 0;     ///< of the resident memory of the process
  std::string origin;                ///< what set the limit
  std::uint64_t engine_bytes = 0;    ///< the budget of the engine
  std::uint64_t resident_bytes = 0;  ///< of these, the blocks of scratch that stay in memory
  /// What the limit leaves beside the engine and the process itself, for images that are decoded.
  std::uint64_t spare_bytes = 0;
  std::size_t block_bytes = 0;    ///< of scratch
  std::size_t queued_blocks = 0;  ///< of the engine's memory, for blocks under way to or from disk
  std::size_t workers = 0;        ///< threads
};

struct MemoryWishes {
  std::optional<std::uint64_t> limit_bytes;   ///< --memory
  std::optional<std::uint64_t> engine_bytes;  ///< --engine-memory
  std::optional<std::uint64_t> block_bytes;   ///< --block-bytes
  std::size_t threads = 0;                    ///< --threads; 0: one a CPU, as far as memory goes
  bool osmesa = false;                        ///< --raster osmesa
};

/// Takes from the limit what the process itself needs (program, thread stacks, and the image
/// library, which is loaded only when a model names an image, but then costs the same whatever the
/// model), and gives the rest to the engine, as far as more memory makes it faster. On a machine of
/// many CPUs and little memory there are fewer threads than CPUs, unless they are asked for. Throws
/// Error(kResource) for a limit below the floor of 256 MiB, or 448 MiB with OSMesa.
MemoryPlan plan_memory(const MemoryWishes& wishes, std::size_t cpus);

}  // namespace atlasgauge
