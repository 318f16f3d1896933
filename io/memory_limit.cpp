#include "io/memory_limit.hpp"

#include <sys/sysinfo.h>

#include <charconv>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace atlasgauge {
namespace {

/// A whole number and nothing else: "max", as a cgroup without a limit has it, is none.
std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  return number;
}

std::optional<std::uint64_t> number_in_file(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  return number_in(line);
}

std::uint64_t saturated_product(std::uint64_t a, std::uint64_t b) {
  std::uint64_t product = 0;
  const bool overflows = __builtin_mul_overflow(a, b, &product);
  return overflows ? std::numeric_limits<std::uint64_t>::max() : product;
}

/// 0 stands for no limit.
void lower(MemoryLimit& limit, std::optional<std::uint64_t> bytes, const std::string& origin) {
  if (bytes && *bytes > 0 && *bytes < limit.bytes) limit = {*bytes, origin};
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

bool contains(const std::vector<std::string>& list, std::string_view wanted) {
  for (const std::string& item : list) {
    if (item == wanted) return true;
  }
  return false;
}

/// mountinfo writes blanks and backslashes as three octal digits after a backslash.
std::string unescaped(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    unsigned code = 0;
    const bool escape =
        text.size() >= 4 && text[0] == '\\' &&
        std::from_chars(text.data() + 1, text.data() + 4, code, 8).ec == std::errc();
    plain += escape ? static_cast<char>(code) : text[0];
    text.remove_prefix(escape ? 4 : 1);
  }
  return plain;
}

enum class CgroupVersion { kV1, kV2 };

/// A mount that shows memory limits of cgroups: `group` and those below it, under `path`.
struct CgroupMount {
  CgroupVersion version;
  std::string group;
  std::string path;
};

/// Lines are "id parent device root mountpoint options [tags ...] - type source super-options".
std::optional<CgroupMount> cgroup_mount_in(const std::string& line) {
  const std::vector<std::string> fields = split(line, ' ');
  std::size_t dash = 6;
  while (dash < fields.size() && fields[dash] != "-") ++dash;
  if (dash + 3 >= fields.size()) return std::nullopt;
  const bool v2 = fields[dash + 1] == "cgroup2";
  const bool v1 = fields[dash + 1] == "cgroup" && contains(split(fields[dash + 3], ','), "memory");
  if (!v1 && !v2) return std::nullopt;
  return CgroupMount{v2 ? CgroupVersion::kV2 : CgroupVersion::kV1, unescaped(fields[3]),
                     unescaped(fields[4])};
}

std::vector<CgroupMount> cgroup_mounts(const std::string& root) {
  std::vector<CgroupMount> mounts;
  std::ifstream lines(root + "/proc/self/mountinfo");
  for (std::string line; std::getline(lines, line);) {
    if (auto mount = cgroup_mount_in(line)) mounts.push_back(std::move(*mount));
  }
  return mounts;
}

/// The group of this process. Lines are "hierarchy:controllers:group"; v2 has no controllers.
std::optional<std::string> own_group(const std::string& root, CgroupVersion version) {
  std::ifstream lines(root + "/proc/self/cgroup");
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool matches = version == CgroupVersion::kV2
                             ? controllers.empty()
                             : contains(split(controllers, ','), "memory");
    if (matches) return line.substr(second + 1);
  }
  return std::nullopt;
}

/// The folder of a group below a mount, as "/a/b". A mount that shows another part of the tree (as
/// in a container that names groups of its host) is taken to show the group itself.
std::string folder_below(const CgroupMount& mount, const std::string& group) {
  const std::string above = mount.group == "/" ? "" : mount.group;
  const std::string below = group == "/" ? "" : group;
  const bool outside = below.starts_with("/..");  // of this process's cgroup namespace
  const bool shown = !outside && (below == above || below.starts_with(above + "/"));
  return shown ? below.substr(above.size()) : "";
}

std::vector<const char*> limit_files(CgroupVersion version) {
  if (version == CgroupVersion::kV1) return {"memory.limit_in_bytes"};
  return {"memory.max", "memory.high"};
}

/// By a group and all groups around it.
void lower_by_cgroup(MemoryLimit& limit, const std::string& root, const CgroupMount& mount,
                     std::string folder) {
  while (true) {
    for (const char* file : limit_files(mount.version)) {
      const std::string path = mount.path + folder + "/" + file;
      lower(limit, number_in_file(root + path), path);
    }
    const std::size_t slash = folder.find_last_of('/');
    if (slash == std::string::npos) return;
    folder.resize(slash);
  }
}

void lower_by_cgroups(MemoryLimit& limit, const std::string& root) {
  for (const CgroupMount& mount : cgroup_mounts(root)) {
    const auto group = own_group(root, mount.version);
    if (group) lower_by_cgroup(limit, root, mount, folder_below(mount, *group));
  }
}

void lower_by_slurm(MemoryLimit& limit, const LimitSources& sources) {
  constexpr std::uint64_t kMiB = 1 << 20;
  const auto number = [&](const char* name) -> std::optional<std::uint64_t> {
    const std::optional<std::string> value = sources.variable(name);
    return value ? number_in(*value) : std::nullopt;
  };
  const auto per_node = number("SLURM_MEM_PER_NODE");  // both in MiB
  const auto per_cpu = number("SLURM_MEM_PER_CPU");
  const auto cpus = number("SLURM_CPUS_ON_NODE");
  if (per_node) lower(limit, saturated_product(*per_node, kMiB), "SLURM_MEM_PER_NODE");
  if (per_cpu && cpus) {
    lower(limit, saturated_product(saturated_product(*per_cpu, *cpus), kMiB),
          "SLURM_MEM_PER_CPU times SLURM_CPUS_ON_NODE");
  }
}

std::optional<std::string> environment_variable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

}  // namespace

LimitSources LimitSources::of_this_process() {
  struct sysinfo machine {};
  ::sysinfo(&machine);
  return {std::uint64_t{machine.totalram} * machine.mem_unit, "", environment_variable};
}

MemoryLimit detect_memory_limit(const LimitSources& sources) {
  MemoryLimit limit{sources.machine_bytes, "the machine's memory"};
  lower_by_cgroups(limit, sources.root);
  lower_by_slurm(limit, sources);
  return limit;
}

}  // namespace atlasgauge
