#pragma once

#include <cstdint>
#include <string>

namespace atlasgauge {

/// How much memory this process may use, and what says so.
struct MemoryLimit {
  std::uint64_t bytes;
  std::string origin;
};

/// The smallest of the machine's memory, the cgroup's limit (v1 or v2, all levels) and the Slurm
/// job's (SLURM_MEM_PER_NODE, or SLURM_MEM_PER_CPU times SLURM_CPUS_ON_NODE).
MemoryLimit detect_memory_limit();

}  // namespace atlasgauge
