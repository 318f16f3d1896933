#include "io/cpu_limit.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "io/cgroup.hpp"

namespace atlasgauge {
namespace {

/// 0 stands for no limit.
void lower(CpuLimit& limit, std::optional<std::uint64_t> cpus, const std::string& origin) {
  if (cpus && *cpus > 0 && *cpus < limit.cpus) limit = {static_cast<std::size_t>(*cpus), origin};
}

/// A quota is time in a period. Half a CPU is one thread, too.
std::optional<std::uint64_t> cpus_of_quota(std::optional<std::uint64_t> quota,
                                           std::optional<std::uint64_t> period) {
  if (!quota || !period || *period == 0) return std::nullopt;
  return *quota / *period + (*quota % *period == 0 ? 0 : 1);
}

std::optional<std::uint64_t> number_in(const std::string& root, const std::string& path) {
  const auto line = cgroup_line(root, path);
  return line ? whole_number(*line) : std::nullopt;
}

void lower_by_v1(CpuLimit& limit, const std::string& root, const std::string& folder) {
  const std::string quota = folder + "/cpu.cfs_quota_us";  // -1: none
  const auto period = number_in(root, folder + "/cpu.cfs_period_us");
  lower(limit, cpus_of_quota(number_in(root, quota), period), quota);
}

/// The file holds "quota period"; the quota may be "max".
void lower_by_v2(CpuLimit& limit, const std::string& root, const std::string& folder) {
  const std::string path = folder + "/cpu.max";
  const std::string line = cgroup_line(root, path).value_or("");
  const std::size_t blank = line.find(' ');
  if (blank == std::string::npos) return;
  lower(limit,
        cpus_of_quota(whole_number(line.substr(0, blank)), whole_number(line.substr(blank + 1))),
        path);
}

void lower_by_cgroups(CpuLimit& limit, const std::string& root) {
  for (const CgroupFolder& folder : cgroup_folders(root, "cpu")) {
    const bool v1 = folder.version == CgroupVersion::kV1;
    v1 ? lower_by_v1(limit, root, folder.path) : lower_by_v2(limit, root, folder.path);
  }
}

void lower_by_slurm(CpuLimit& limit, const LimitSources& sources) {
  if (!sources.variable("SLURM_JOB_ID")) return;
  const bool per_task = sources.variable("SLURM_CPUS_PER_TASK").has_value();
  const std::string name = per_task ? "SLURM_CPUS_PER_TASK" : "SLURM_CPUS_ON_NODE";
  lower(limit, sources.number(name), name);
}

}  // namespace

CpuLimit detect_cpu_limit(const LimitSources& sources) {
  CpuLimit limit{std::max<std::size_t>(1, sources.affinity_cpus), "the process's CPU affinity"};
  lower_by_cgroups(limit, sources.root);
  lower_by_slurm(limit, sources);
  return limit;
}

}  // namespace atlasgauge
