#pragma once

#include <cstdint>
#include <string>

#include "io/limit_sources.hpp"

namespace atlasgauge {

/// How much memory this process may use, and what says so.
struct MemoryLimit {
  std::uint64_t bytes;
  std::string origin;
};

/// The smallest of the machine's memory, the cgroup's limit and the Slurm job's.
///
/// cgroup: memory.max and memory.high (above which the kernel slows a group down to a crawl) of v2,
/// memory.limit_in_bytes of v1, of the process's own group and all around it that the mounts show,
/// wherever they are mounted. Slurm: SLURM_MEM_PER_NODE, or SLURM_MEM_PER_CPU times
/// SLURM_CPUS_ON_NODE; 0 is no limit. Swap is not memory and never counts.
MemoryLimit detect_memory_limit(const LimitSources& sources = LimitSources::of_this_process());

}  // namespace atlasgauge
