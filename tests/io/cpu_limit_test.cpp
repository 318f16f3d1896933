#include "io/cpu_limit.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <cstddef>
#include <string>
#include <utility>

#include "tests/io/limited_system.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kAffinity = 64;
constexpr const char* kV2Mount =
    "31 23 0:28 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";
constexpr const char* kV1Mount =
    "35 31 0:32 / /sys/fs/cgroup/cpu rw,relatime - cgroup cgroup rw,cpu,cpuacct\n";

class CpuLimitTest : public testing::Test, protected LimitedSystem {
 protected:
  CpuLimitTest() : LimitedSystem(1, kAffinity) {}
  void expect_limit(std::size_t cpus, const std::string& origin) const {
    const CpuLimit limit = detect_cpu_limit(sources());
    EXPECT_EQ(limit.cpus, cpus);
    EXPECT_EQ(limit.origin, origin);
  }
  void expect_no_limit() const { expect_limit(kAffinity, "the process's CPU affinity"); }
};

TEST_F(CpuLimitTest, AffinityIsTheLimitWhereNothingElseIsSaid) {
  expect_no_limit();
}

TEST_F(CpuLimitTest, CgroupV2LimitsByQuota) {
  group_is("0::/user/job\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/user/job/cpu.max", "400000 100000");
  expect_limit(4, "/sys/fs/cgroup/user/job/cpu.max");
}

TEST_F(CpuLimitTest, PartsOfACpuCountAsOne) {
  group_is("0::/job\n");
  mounts_are(kV2Mount);
  for (const auto& [content, cpus] : {std::pair("150000 100000", 2), std::pair("100001 100000", 2),
                                      std::pair("1000 100000", 1), std::pair("75000 25000", 3)}) {
    file("/sys/fs/cgroup/job/cpu.max", content);
    expect_limit(static_cast<std::size_t>(cpus), "/sys/fs/cgroup/job/cpu.max");
  }
}

TEST_F(CpuLimitTest, MaxMeansNoLimit) {
  group_is("0::/job\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/job/cpu.max", "max 100000");
  expect_no_limit();
}

TEST_F(CpuLimitTest, SmallestOfNestedGroupsCounts) {
  group_is("0::/a/b/c\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/a/cpu.max", "200000 100000");
  file("/sys/fs/cgroup/a/b/cpu.max", "max 100000");
  file("/sys/fs/cgroup/a/b/c/cpu.max", "800000 100000");
  expect_limit(2, "/sys/fs/cgroup/a/cpu.max");
}

TEST_F(CpuLimitTest, ContainerWithItsOwnNamespaceReadsItsRoot) {
  group_is("0::/\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/cpu.max", "300000 100000");
  expect_limit(3, "/sys/fs/cgroup/cpu.max");
}

TEST_F(CpuLimitTest, CgroupV1LimitsByQuotaOverPeriod) {
  group_is("9:name=systemd:/\n5:cpuset:/other\n4:cpu,cpuacct:/job\n");
  mounts_are(kV1Mount);
  file("/sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "125000");
  file("/sys/fs/cgroup/cpu/job/cpu.cfs_period_us", "50000");
  file("/sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1");
  file("/sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000");
  expect_limit(3, "/sys/fs/cgroup/cpu/job/cpu.cfs_quota_us");
}

TEST_F(CpuLimitTest, GroupsOfOtherControllersDoNotCount) {
  group_is("5:cpuset:/job\n4:memory:/job\n");
  mounts_are(
      "35 31 0:32 / /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n"
      "36 31 0:33 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n");
  for (const char* folder : {"cpuset", "memory"}) {
    file("/sys/fs/cgroup/" + std::string(folder) + "/job/cpu.cfs_quota_us", "100000");
    file("/sys/fs/cgroup/" + std::string(folder) + "/job/cpu.cfs_period_us", "100000");
  }
  expect_no_limit();
}

TEST_F(CpuLimitTest, BrokenFilesSayNothing) {
  group_is("4:cpu:/job\n0::/job\n");
  mounts_are(fmt::format("{}{}", kV1Mount, kV2Mount));
  for (const char* content : {"", "many", "100000", "-1 100000", "1 0", "0 100000", "1 1 1", "1 x",
                              " ", "99999999999999999999999 1"}) {
    file("/sys/fs/cgroup/job/cpu.max", content);
    expect_no_limit();
  }
  file("/sys/fs/cgroup/cpu/job/cpu.cfs_quota_us", "100000");
  expect_no_limit();
  file("/sys/fs/cgroup/cpu/job/cpu.cfs_period_us", "0");
  expect_no_limit();
}

TEST_F(CpuLimitTest, SlurmLimitsPerTask) {
  variable_is("SLURM_JOB_ID", "1");
  variable_is("SLURM_CPUS_PER_TASK", "8");
  variable_is("SLURM_CPUS_ON_NODE", "4");
  expect_limit(8, "SLURM_CPUS_PER_TASK");
}

TEST_F(CpuLimitTest, SlurmLimitsPerNodeWhereTasksHaveNoNumber) {
  variable_is("SLURM_JOB_ID", "1");
  variable_is("SLURM_CPUS_ON_NODE", "4");
  expect_limit(4, "SLURM_CPUS_ON_NODE");
}

TEST_F(CpuLimitTest, SlurmCountsOnlyInsideAJob) {
  variable_is("SLURM_CPUS_PER_TASK", "8");
  variable_is("SLURM_CPUS_ON_NODE", "4");
  expect_no_limit();
}

TEST_F(CpuLimitTest, SlurmNumbersThatAreNoneAreNotGuessedAt) {
  variable_is("SLURM_JOB_ID", "1");
  for (const char* value : {"", "0", "4(x2)", "-3"}) {
    variable_is("SLURM_CPUS_PER_TASK", value);
    expect_no_limit();
  }
}

TEST_F(CpuLimitTest, SmallestOfAllCounts) {
  group_is("0::/job\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/job/cpu.max", "800000 100000");
  variable_is("SLURM_JOB_ID", "1");
  variable_is("SLURM_CPUS_PER_TASK", "16");
  expect_limit(8, "/sys/fs/cgroup/job/cpu.max");
  variable_is("SLURM_CPUS_PER_TASK", "2");
  expect_limit(2, "SLURM_CPUS_PER_TASK");
}

TEST_F(CpuLimitTest, LargerLimitsThanTheAffinityDoNotCount) {
  group_is("0::/job\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/job/cpu.max", "6400000 100000");
  variable_is("SLURM_JOB_ID", "1");
  variable_is("SLURM_CPUS_PER_TASK", "128");
  expect_no_limit();
}

TEST_F(CpuLimitTest, ThisProcessMayUseACpuAndNoMoreThanItsAffinity) {
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  if (::sched_getaffinity(0, sizeof(cpus), &cpus) != 0) GTEST_SKIP() << "more than 1024 CPUs";
  const CpuLimit limit = detect_cpu_limit();
  EXPECT_GE(limit.cpus, 1U);
  EXPECT_LE(limit.cpus, static_cast<std::size_t>(CPU_COUNT(&cpus)));
  EXPECT_EQ(LimitSources::of_this_process().affinity_cpus,
            static_cast<std::size_t>(CPU_COUNT(&cpus)));
}

}  // namespace
}  // namespace atlasgauge
