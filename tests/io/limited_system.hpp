#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "io/limit_sources.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {

/// A system whose files lie in a folder and whose variables in a map.
class LimitedSystem {
 public:
  LimitedSystem(std::uint64_t bytes, std::size_t cpus) : bytes_(bytes), cpus_(cpus) {}

  /// The lines of the process's groups.
  void group_is(const std::string& lines) const { dir_.write("proc/self/cgroup", lines); }
  /// Mounts beside those of the system.
  void mounts_are(const std::string& lines) const {
    dir_.write("proc/self/mountinfo",
               "23 1 254:0 / / rw,relatime - ext4 /dev/vda rw\n"
               "24 23 0:30 / /sys/fs/cgroup/pids rw - cgroup cgroup rw,pids\n" +
                   lines);
  }
  void file(const std::string& path, const std::string& content) const {
    dir_.write(path.substr(1), content + "\n");
  }
  void variable_is(const std::string& name, const std::string& value) { variables_[name] = value; }

  LimitSources sources() const {
    return {bytes_, dir_.path().string(),
            [this](const std::string& name) {
              const auto found = variables_.find(name);
              return found == variables_.end() ? std::nullopt
                                               : std::optional<std::string>(found->second);
            },
            cpus_};
  }

 private:
  std::uint64_t bytes_;
  std::size_t cpus_;
  TempDir dir_;
  std::map<std::string, std::string> variables_;
};

}  // namespace atlasgauge
