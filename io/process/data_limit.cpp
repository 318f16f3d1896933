#include "io/process/data_limit.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;
/// Main, readers and writers.
constexpr std::uint64_t kOtherThreads = 8;
/// Beside the stacks, runs were seen to need from 130 MiB less than their limit to 40 MiB more.
constexpr std::uint64_t kFixedBytes = 256 * kMiB;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // these map terabytes
#else
constexpr bool kSanitized = false;
#endif

/// Of a thread: the system's choice, and less than this where there is no limit.
std::uint64_t stack_bytes() {
  constexpr std::uint64_t kUsual = 8 * kMiB;
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUsual;
  return limit.rlim_cur;
}

std::uint64_t cpus_of_the_machine() {
  return static_cast<std::uint64_t>(std::max(1L, ::sysconf(_SC_NPROCESSORS_CONF)));
}

}  // namespace

std::uint64_t data_limit(std::uint64_t memory_bytes, std::size_t threads) {
  if (kSanitized) return 0;
  const std::uint64_t most_threads = threads + cpus_of_the_machine() + kOtherThreads;
  return memory_bytes + most_threads * stack_bytes() + kFixedBytes;
}

}  // namespace atlasgauge
