#include "io/memory_limit.hpp"

#include <sys/sysinfo.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

namespace atlasgauge {
namespace {

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || rest == text.data()) return std::nullopt;
  return number;
}

std::optional<std::uint64_t> number_in_file(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  return number_in(line);
}

std::optional<std::uint64_t> number_in_environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::nullopt : number_in(value);
}

void lower(MemoryLimit& limit, std::optional<std::uint64_t> bytes, const std::string& origin) {
  if (bytes && *bytes > 0 && *bytes < limit.bytes) limit = {*bytes, origin};
}

/// Limits of a cgroup and all groups around it.
void lower_by_cgroup(MemoryLimit& limit, const std::string& mount, std::string group,
                     const char* file) {
  while (true) {
    lower(limit, number_in_file(mount + group + "/" + file), "cgroup " + mount + group);
    const std::size_t slash = group.find_last_of('/');
    if (slash == std::string::npos) return;
    group.resize(slash);
  }
}

/// Lines of /proc/self/cgroup are "hierarchy:controllers:group"; v2 has no controllers.
void lower_by_cgroups(MemoryLimit& limit) {
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty()) {
      lower_by_cgroup(limit, "/sys/fs/cgroup", group, "memory.max");
    } else if (controllers.find("memory") != std::string::npos) {
      lower_by_cgroup(limit, "/sys/fs/cgroup/memory", group, "memory.limit_in_bytes");
    }
  }
}

void lower_by_slurm(MemoryLimit& limit) {
  const auto per_node = number_in_environment("SLURM_MEM_PER_NODE");  // both in MiB
  const auto per_cpu = number_in_environment("SLURM_MEM_PER_CPU");
  const auto cpus = number_in_environment("SLURM_CPUS_ON_NODE");
  if (per_node) lower(limit, *per_node << 20, "SLURM_MEM_PER_NODE");
  if (per_cpu && cpus) lower(limit, (*per_cpu * *cpus) << 20, "SLURM_MEM_PER_CPU");
}

}  // namespace

MemoryLimit detect_memory_limit() {
  struct sysinfo machine {};
  sysinfo(&machine);
  MemoryLimit limit{std::uint64_t{machine.totalram} * machine.mem_unit, "the machine's memory"};
  lower_by_cgroups(limit);
  lower_by_slurm(limit);
  return limit;
}

}  // namespace atlasgauge
