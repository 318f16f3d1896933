#include "io/memory_limit.hpp"

#include <limits>
#include <optional>
#include <vector>

#include "io/cgroup.hpp"

namespace atlasgauge {
namespace {

std::uint64_t saturated_product(std::uint64_t a, std::uint64_t b) {
  std::uint64_t product = 0;
  const bool overflows = __builtin_mul_overflow(a, b, &product);
  return overflows ? std::numeric_limits<std::uint64_t>::max() : product;
}

/// 0 stands for no limit.
void lower(MemoryLimit& limit, std::optional<std::uint64_t> bytes, const std::string& origin) {
  if (bytes && *bytes > 0 && *bytes < limit.bytes) limit = {*bytes, origin};
}

std::vector<const char*> limit_files(CgroupVersion version) {
  if (version == CgroupVersion::kV1) return {"memory.limit_in_bytes"};
  return {"memory.max", "memory.high"};
}

void lower_by_cgroups(MemoryLimit& limit, const std::string& root) {
  for (const CgroupFolder& folder : cgroup_folders(root, "memory")) {
    for (const char* file : limit_files(folder.version)) {
      const std::string path = folder.path + "/" + file;
      const auto line = cgroup_line(root, path);
      if (line) lower(limit, whole_number(*line), path);
    }
  }
}

void lower_by_slurm(MemoryLimit& limit, const LimitSources& sources) {
  constexpr std::uint64_t kMiB = 1 << 20;
  const auto per_node = sources.number("SLURM_MEM_PER_NODE");  // both in MiB
  const auto per_cpu = sources.number("SLURM_MEM_PER_CPU");
  const auto cpus = sources.number("SLURM_CPUS_ON_NODE");
  if (per_node) lower(limit, saturated_product(*per_node, kMiB), "SLURM_MEM_PER_NODE");
  if (per_cpu && cpus) {
    lower(limit, saturated_product(saturated_product(*per_cpu, *cpus), kMiB),
          "SLURM_MEM_PER_CPU times SLURM_CPUS_ON_NODE");
  }
}

}  // namespace

MemoryLimit detect_memory_limit(const LimitSources& sources) {
  MemoryLimit limit{sources.machine_bytes, "the machine's memory"};
  lower_by_cgroups(limit, sources.root);
  lower_by_slurm(limit, sources);
  return limit;
}

}  // namespace atlasgauge
