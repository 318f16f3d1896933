#include "io/limit_sources.hpp"

#include <sched.h>
#include <sys/sysinfo.h>

#include <array>
#include <cstdlib>

#include "io/parsed_number.hpp"

namespace atlasgauge {
namespace {

std::optional<std::string> environment_variable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::uint64_t bytes_of_the_machine() {
  struct sysinfo machine {};
  ::sysinfo(&machine);
  return std::uint64_t{machine.totalram} * machine.mem_unit;
}

/// A single set, of 1024 CPUs, is refused on larger machines.
std::size_t cpus_of_the_affinity() {
  std::array<cpu_set_t, 16> cpus{};
  if (::sched_getaffinity(0, sizeof(cpus), cpus.data()) != 0) return 1;
  return static_cast<std::size_t>(CPU_COUNT_S(sizeof(cpus), cpus.data()));
}

}  // namespace

LimitSources LimitSources::of_this_process() {
  return {bytes_of_the_machine(), "", environment_variable, cpus_of_the_affinity()};
}

std::optional<std::uint64_t> LimitSources::number(const std::string& name) const {
  const std::optional<std::string> value = variable(name);
  return value ? whole_number(*value) : std::nullopt;
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  return parsed_number<std::uint64_t>(text);
}

}  // namespace atlasgauge
