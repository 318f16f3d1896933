#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace atlasgauge {

enum class CgroupVersion { kV1, kV2 };

/// Where a cgroup's files lie.
struct CgroupFolder {
  CgroupVersion version;
  std::string path;  ///< without the root that it was looked for in
};

/// The cgroups whose limits hold for this process, as far as a controller ("memory", "cpu") goes:
/// its own group and all around it that the mounts show, from within outwards, wherever they are
/// mounted; of both versions. `root` stands before /proc and before the mounts.
std::vector<CgroupFolder> cgroup_folders(const std::string& root, std::string_view controller);

/// The first line of a file of a cgroup; none where there is no such file.
std::optional<std::string> cgroup_line(const std::string& root, const std::string& path);

}  // namespace atlasgauge
