#include "io/cgroup.hpp"

#include <charconv>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <utility>

namespace atlasgauge {
namespace {

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

/// A mount that shows cgroups of a controller: `group` and those below it, under `path`.
struct CgroupMount {
  CgroupVersion version;
  std::string group;
  std::string path;
};

/// Lines are "id parent device root mountpoint options [tags ...] - type source super-options".
std::optional<CgroupMount> cgroup_mount_in(const std::string& line, std::string_view controller) {
  const std::vector<std::string> fields = split(line, ' ');
  std::size_t dash = 6;
  while (dash < fields.size() && fields[dash] != "-") ++dash;
  if (dash + 3 >= fields.size()) return std::nullopt;
  const bool v2 = fields[dash + 1] == "cgroup2";
  const bool v1 =
      fields[dash + 1] == "cgroup" && contains(split(fields[dash + 3], ','), controller);
  if (!v1 && !v2) return std::nullopt;
  return CgroupMount{v2 ? CgroupVersion::kV2 : CgroupVersion::kV1, unescaped(fields[3]),
                     unescaped(fields[4])};
}

std::vector<CgroupMount> cgroup_mounts(const std::string& root, std::string_view controller) {
  std::vector<CgroupMount> mounts;
  std::ifstream lines(root + "/proc/self/mountinfo");
  for (std::string line; std::getline(lines, line);) {
    if (auto mount = cgroup_mount_in(line, controller)) mounts.push_back(std::move(*mount));
  }
  return mounts;
}

/// The group of this process. Lines are "hierarchy:controllers:group"; v2 has no controllers.
std::optional<std::string> own_group(const std::string& root, CgroupVersion version,
                                     std::string_view controller) {
  std::ifstream lines(root + "/proc/self/cgroup");
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool matches = version == CgroupVersion::kV2
                             ? controllers.empty()
                             : contains(split(controllers, ','), controller);
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

/// A group and all groups around it.
void add_folders(const CgroupMount& mount, std::string folder, std::vector<CgroupFolder>& folders) {
  while (true) {
    folders.push_back({mount.version, mount.path + folder});
    const std::size_t slash = folder.find_last_of('/');
    if (slash == std::string::npos) return;
    folder.resize(slash);
  }
}

}  // namespace

std::vector<CgroupFolder> cgroup_folders(const std::string& root, std::string_view controller) {
  std::vector<CgroupFolder> folders;
  for (const CgroupMount& mount : cgroup_mounts(root, controller)) {
    const auto group = own_group(root, mount.version, controller);
    if (group) add_folders(mount, folder_below(mount, *group), folders);
  }
  return folders;
}

std::optional<std::string> cgroup_line(const std::string& root, const std::string& path) {
  std::ifstream file(root + path);
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  return line;
}

}  // namespace atlasgauge
