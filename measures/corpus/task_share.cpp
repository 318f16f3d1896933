#include "measures/corpus/task_share.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/bytes.hpp"
#include "io/cpu_limit.hpp"
#include "io/error.hpp"
#include "io/memory_limit.hpp"
#include "stream/memory_plan.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kUsualModelBytes = std::uint64_t{512} << 20;

std::size_t usual_jobs(const TaskShare& share, std::size_t models) {
  const std::uint64_t roomy = share.memory_bytes / kUsualModelBytes;
  return std::max<std::size_t>(1, std::min<std::uint64_t>({share.threads, roomy, models}));
}

/// So that a task finds out at its start, not model by model.
void check_share(const TaskShare& share) {
  const ModelShare one = share.of_one(share.jobs);
  MemoryWishes wishes;
  wishes.limit_bytes = one.memory_bytes;
  wishes.threads = one.threads;
  try {
    plan_memory(wishes, one.threads);
  } catch (const Error& error) {
    throw Error(ErrorKind::kResource,
                fmt::format("{} for {} models side by side: {}; or give fewer --jobs",
                            format_bytes(share.memory_bytes), share.jobs, error.what()));
  }
}

}  // namespace

ModelShare TaskShare::of_one(std::size_t models) const {
  return {memory_bytes / models, std::max<std::size_t>(1, threads / models), tmp_dir};
}

TaskShare share_of_task(const CorpusRunOptions& options, std::size_t models) {
  TaskShare share;
  share.memory_bytes = options.memory_bytes.value_or(detect_memory_limit().bytes / 10 * 8);
  share.threads = options.threads > 0 ? options.threads : detect_cpu_limit().cpus;
  share.jobs = options.jobs > 0 ? std::min(options.jobs, models) : usual_jobs(share, models);
  share.tmp_dir = options.tmp_dir;
  check_share(share);
  return share;
}

}  // namespace atlasgauge
