#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace atlasgauge {

/// Where limits of this process are looked up.
struct LimitSources {
  std::uint64_t machine_bytes;
  std::string root;  ///< stands before /proc and before the cgroup mounts
  std::function<std::optional<std::string>(const std::string& name)> variable;
  std::size_t affinity_cpus = 1;  ///< on which the process may run

  static LimitSources of_this_process();

  /// A variable that is a whole number and nothing else.
  std::optional<std::uint64_t> number(const std::string& name) const;
};

/// A whole number and nothing else: "max", as a cgroup without a limit has it, is none.
std::optional<std::uint64_t> whole_number(std::string_view text);

}  // namespace atlasgauge
