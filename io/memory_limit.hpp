#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace atlasgauge {

/// How much memory this process may use, and what says so.
struct MemoryLimit {
  std::uint64_t bytes;
  std::string origin;
};

/// Where limits are looked up.
struct LimitSources {
  std::uint64_t machine_bytes;
  std::string root;  ///< stands before /proc and before the cgroup mounts
  std::function<std::optional<std::string>(const std::string& name)> variable;

  static LimitSources of_this_process();
};

/// The smallest of the machine's memory, the cgroup's limit and the Slurm job's.
///
/// cgroup: memory.max and memory.high (above which the kernel slows a group down to a crawl) of v2,
/// memory.limit_in_bytes of v1, of the process's own group and all around it that the mounts show,
/// wherever they are mounted. Slurm: SLURM_MEM_PER_NODE, or SLURM_MEM_PER_CPU times
/// SLURM_CPUS_ON_NODE; 0 is no limit. Swap is not memory and never counts.
MemoryLimit detect_memory_limit(const LimitSources& sources = LimitSources::of_this_process());

}  // namespace atlasgauge
