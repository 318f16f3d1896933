#pragma once

#include <cstddef>
#include <string>

#include "io/limit_sources.hpp"

namespace atlasgauge {

/// How many CPUs this process may keep busy, and what says so.
struct CpuLimit {
  std::size_t cpus;
  std::string origin;
};

/// The least of the CPUs that the process may run on, the cgroup's quota and the Slurm job's; at
/// least 1.
///
/// cgroup: cpu.max of v2, cpu.cfs_quota_us over cpu.cfs_period_us of v1, rounded up, of the
/// process's own group and all around it that the mounts show. Slurm, inside a job:
/// SLURM_CPUS_PER_TASK, else SLURM_CPUS_ON_NODE.
CpuLimit detect_cpu_limit(const LimitSources& sources = LimitSources::of_this_process());

}  // namespace atlasgauge
