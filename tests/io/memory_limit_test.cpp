#include "io/memory_limit.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/io/limited_system.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;
constexpr std::uint64_t kMachine = 65536 * kMiB;
constexpr const char* kMachineOrigin = "the machine's memory";
constexpr const char* kV2Mount =
    "31 23 0:28 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";
constexpr const char* kV1Mount =
    "35 31 0:32 / /sys/fs/cgroup/memory rw,relatime - cgroup cgroup rw,memory\n";

class MemoryLimitTest : public testing::Test, protected LimitedSystem {
 protected:
  MemoryLimitTest() : LimitedSystem(kMachine, 1) {}
  void expect_limit(std::uint64_t mib, const std::string& origin) const {
    const MemoryLimit limit = detect_memory_limit(sources());
    EXPECT_EQ(limit.bytes, mib * kMiB);
    EXPECT_EQ(limit.origin, origin);
  }
  void expect_no_limit() const { expect_limit(kMachine / kMiB, kMachineOrigin); }
};

TEST_F(MemoryLimitTest, MachineIsTheLimitWhereNothingElseIsSaid) {
  expect_no_limit();
}

TEST_F(MemoryLimitTest, CgroupV2LimitsByMax) {
  group_is("0::/user/job\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/user/job/memory.max", "1073741824");
  expect_limit(1024, "/sys/fs/cgroup/user/job/memory.max");
}

TEST_F(MemoryLimitTest, MaxMeansNoLimit) {
  group_is("0::/job\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/job/memory.max", "max");
  file("/sys/fs/cgroup/job/memory.high", "max");
  expect_no_limit();
}

TEST_F(MemoryLimitTest, SmallestOfNestedGroupsCounts) {
  group_is("0::/a/b/c\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/a/memory.max", "536870912");
  file("/sys/fs/cgroup/a/b/memory.max", "max");
  file("/sys/fs/cgroup/a/b/c/memory.max", "1073741824");
  expect_limit(512, "/sys/fs/cgroup/a/memory.max");
}

TEST_F(MemoryLimitTest, GroupsBesideDoNotCount) {
  group_is("0::/a/b\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/a/c/memory.max", "536870912");
  file("/sys/fs/cgroup/a/b/d/memory.max", "536870912");
  expect_no_limit();
}

TEST_F(MemoryLimitTest, HighCountsAsALimit) {
  group_is("0::/job\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/job/memory.max", "1073741824");
  file("/sys/fs/cgroup/job/memory.high", "805306368");
  expect_limit(768, "/sys/fs/cgroup/job/memory.high");
}

TEST_F(MemoryLimitTest, SwapDoesNotCount) {
  group_is("0::/job\n4:memory:/job\n");
  mounts_are(std::string(kV2Mount) + kV1Mount);
  file("/sys/fs/cgroup/job/memory.swap.max", "1048576");
  file("/sys/fs/cgroup/memory/job/memory.memsw.limit_in_bytes", "1048576");
  file("/sys/fs/cgroup/memory/job/memory.soft_limit_in_bytes", "1048576");
  expect_no_limit();
}

TEST_F(MemoryLimitTest, ContainerWithItsOwnNamespaceReadsItsRoot) {
  group_is("0::/\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/memory.max", "1073741824");
  expect_limit(1024, "/sys/fs/cgroup/memory.max");
}

TEST_F(MemoryLimitTest, CgroupV1LimitsByLimitInBytes) {
  group_is("9:name=systemd:/\n5:cpu,memory:/job\n1:memory_not:/other\n");
  mounts_are(kV1Mount);
  file("/sys/fs/cgroup/memory/job/memory.limit_in_bytes", "1073741824");
  file("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
  expect_limit(1024, "/sys/fs/cgroup/memory/job/memory.limit_in_bytes");
}

TEST_F(MemoryLimitTest, ContainerOfV1ThatNamesItsHostsGroupReadsTheMount) {
  group_is("4:memory:/docker/abc\n");
  mounts_are("35 31 0:32 /docker/abc /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n");
  file("/sys/fs/cgroup/memory/memory.limit_in_bytes", "1073741824");
  expect_limit(1024, "/sys/fs/cgroup/memory/memory.limit_in_bytes");
}

TEST_F(MemoryLimitTest, GroupBelowTheOneThatTheMountShowsIsFound) {
  group_is("4:memory:/docker/abc/job\n");
  mounts_are("35 31 0:32 /docker/abc /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n");
  file("/sys/fs/cgroup/memory/job/memory.limit_in_bytes", "536870912");
  file("/sys/fs/cgroup/memory/memory.limit_in_bytes", "1073741824");
  expect_limit(512, "/sys/fs/cgroup/memory/job/memory.limit_in_bytes");
}

TEST_F(MemoryLimitTest, GroupThatTheMountDoesNotShowIsTheMountsOwn) {
  for (const char* group : {"/kubepods/pod1", "/docker/abcdef", "/../other"}) {
    SCOPED_TRACE(group);
    group_is(std::string("4:memory:") + group + "\n");
    mounts_are("35 31 0:32 /docker/abc /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n");
    file("/sys/fs/cgroup/memory/memory.limit_in_bytes", "1073741824");
    expect_limit(1024, "/sys/fs/cgroup/memory/memory.limit_in_bytes");
  }
}

TEST_F(MemoryLimitTest, GroupWithoutAFolderIsLimitedByThoseAround) {
  group_is("0::/gone/away\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/memory.max", "1073741824");
  expect_limit(1024, "/sys/fs/cgroup/memory.max");
}

TEST_F(MemoryLimitTest, GroupOutsideTheNamespaceReadsNothingAboveTheMount) {
  group_is("0::/../..\n");
  mounts_are(kV2Mount);
  file("/sys/fs/memory.max", "1");
  expect_no_limit();
}

TEST_F(MemoryLimitTest, HybridHierarchiesAreBothRead) {
  group_is("4:memory:/v1\n0::/v2\n");
  mounts_are(std::string(kV1Mount) +
             "41 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n");
  file("/sys/fs/cgroup/memory/v1/memory.limit_in_bytes", "1073741824");
  expect_limit(1024, "/sys/fs/cgroup/memory/v1/memory.limit_in_bytes");
  file("/sys/fs/cgroup/unified/v2/memory.max", "536870912");
  expect_limit(512, "/sys/fs/cgroup/unified/v2/memory.max");
}

TEST_F(MemoryLimitTest, MountsLieAnywhere) {
  group_is("4:memory:/job\n");
  mounts_are("35 31 0:32 / /my\\040groups/m rw shared:1 master:2 - cgroup none rw,cpu,memory\n");
  file("/my groups/m/job/memory.limit_in_bytes", "1073741824");
  expect_limit(1024, "/my groups/m/job/memory.limit_in_bytes");
}

TEST_F(MemoryLimitTest, BrokenFilesSayNothing) {
  for (const char* lines : {"", "\n", "::\n", "0\n", "0::\n"}) {
    group_is(lines);
    mounts_are(std::string(kV2Mount) + "1 2\n- - -\n1 2 3 4 5 6 7 8 -\n");
    expect_no_limit();
  }
  group_is("0::/job\n");
  for (const char* content : {"", "many", "-1", "12x", "99999999999999999999999", "0"}) {
    file("/sys/fs/cgroup/job/memory.max", content);
    expect_no_limit();
  }
}

TEST_F(MemoryLimitTest, SlurmLimitsPerNode) {
  variable_is("SLURM_MEM_PER_NODE", "4096");
  expect_limit(4096, "SLURM_MEM_PER_NODE");
}

TEST_F(MemoryLimitTest, SlurmLimitsPerCpuTimesCpus) {
  variable_is("SLURM_MEM_PER_CPU", "2048");
  expect_no_limit();
  variable_is("SLURM_CPUS_ON_NODE", "3");
  expect_limit(6144, "SLURM_MEM_PER_CPU times SLURM_CPUS_ON_NODE");
}

TEST_F(MemoryLimitTest, ZeroIsNoLimitInSlurm) {
  variable_is("SLURM_MEM_PER_NODE", "0");
  variable_is("SLURM_MEM_PER_CPU", "0");
  variable_is("SLURM_CPUS_ON_NODE", "8");
  expect_no_limit();
}

TEST_F(MemoryLimitTest, SlurmNumbersTooLargeAreNoLimit) {
  variable_is("SLURM_MEM_PER_NODE", "17592186044416");  // times 2^20 is 2^64
  variable_is("SLURM_MEM_PER_CPU", "17592186044417");
  variable_is("SLURM_CPUS_ON_NODE", "18446744073709551615");
  expect_no_limit();
}

TEST_F(MemoryLimitTest, SlurmNumbersWithUnitsAreNotGuessedAt) {
  variable_is("SLURM_MEM_PER_NODE", "4G");
  expect_no_limit();
}

TEST_F(MemoryLimitTest, SmallestOfAllCounts) {
  group_is("0::/job\n");
  mounts_are(kV2Mount);
  file("/sys/fs/cgroup/job/memory.max", "1073741824");
  variable_is("SLURM_MEM_PER_NODE", "2048");
  expect_limit(1024, "/sys/fs/cgroup/job/memory.max");
  variable_is("SLURM_MEM_PER_NODE", "512");
  expect_limit(512, "SLURM_MEM_PER_NODE");
}

TEST_F(MemoryLimitTest, ThisProcessHasALimit) {
  const MemoryLimit limit = detect_memory_limit();
  EXPECT_GT(limit.bytes, 0U);
  EXPECT_NE(limit.origin, "");
}

}  // namespace
}  // namespace atlasgauge
