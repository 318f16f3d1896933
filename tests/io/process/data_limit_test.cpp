#include "io/process/data_limit.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/io/process/other_process.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

bool is_sanitized() {
  return data_limit(0, 0) == 0;
}

TEST(DataLimitTest, GrowsWithMemoryAndWithThreads) {
  if (is_sanitized()) GTEST_SKIP() << "no limit under sanitizers";
  OtherProcess process([] {
    const rlimit stack{8 * kMiB, RLIM_INFINITY};
    ::setrlimit(RLIMIT_STACK, &stack);
    const std::uint64_t limit = data_limit(256 * kMiB, 1);
    if (limit < 512 * kMiB) return 1;
    if (data_limit(512 * kMiB, 1) != limit + 256 * kMiB) return 2;
    return data_limit(256 * kMiB, 3) == limit + 16 * kMiB ? 0 : 3;
  });
  EXPECT_EQ(process.wait().value(), 0);
}

TEST(DataLimitTest, CountsStacksAsLargeAsTheyAre) {
  if (is_sanitized()) GTEST_SKIP() << "no limit under sanitizers";
  OtherProcess process([] {
    const rlimit stack{64 * kMiB, 64 * kMiB};
    if (::setrlimit(RLIMIT_STACK, &stack) != 0) return 1;
    return data_limit(0, 2) == data_limit(0, 1) + 64 * kMiB ? 0 : 2;
  });
  EXPECT_EQ(process.wait().value(), 0);
}

}  // namespace
}  // namespace atlasgauge
