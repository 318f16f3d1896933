// What stages really allocate, against their budget: budgets of a few hundred kilobytes, inputs of
// tens of megabytes, resident memory as the system sees it.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <random>
#include <utility>

#include "io/mesh_batch.hpp"
#include "stream/engine/gather.hpp"
#include "stream/engine/labels.hpp"
#include "stream/engine/page_cache.hpp"
#include "stream/engine/quantiles.hpp"
#include "stream/engine/sort_spill.hpp"
#include "tests/support/engine_fixture.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SKIP_IF_SANITIZED GTEST_SKIP() << "sanitizers keep freed memory"
#else
#define SKIP_IF_SANITIZED static_cast<void>(0)
#endif

namespace atlasgauge {
namespace {

std::int64_t peak_kib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/// Ends this (child) process: with 0 if the work kept to the budget and a slack of one megabyte for
/// the allocator and small objects.
template <class Work>
[[noreturn]] void exit_by_growth(const TestEngine& engine, Work work) {
  const std::int64_t before = peak_kib();
  work();
  const auto budget_kib = static_cast<std::int64_t>(engine.budget.limit_bytes() >> 10);
  std::_Exit(peak_kib() - before <= budget_kib + 1024 ? 0 : 1);
}

template <class T, class Make>
Spill<T> many(TestEngine& engine, std::uint32_t count, Make make) {
  SpillWriter<T> writer(engine.scratch);
  for (std::uint32_t i = 0; i < count; ++i) writer.push(make(i));
  return writer.finish();
}

#define EXPECT_WITHIN_BUDGET(work) EXPECT_EXIT(work(), testing::ExitedWithCode(0), "")

void select_from(double (*value)(std::uint32_t)) {
  TestEngine engine({.budget_bytes = 512 << 10});
  SampleStore store(engine.scratch);
  SampleStore::Writer writer(store);
  for (std::uint32_t i = 0; i < 1000000; ++i) writer.push({value(i), 1});
  writer.flush();
  exit_by_growth(engine, [&] { store.finish().select(engine); });
}

TEST(ResidentMemoryTest, QuantilesOfDistinctValues) {
  SKIP_IF_SANITIZED;
  EXPECT_WITHIN_BUDGET([] { select_from([](std::uint32_t i) { return 1.0 + i; }); });
}

TEST(ResidentMemoryTest, QuantilesOfOneValue) {
  SKIP_IF_SANITIZED;
  EXPECT_WITHIN_BUDGET([] { select_from([](std::uint32_t) { return 1.0; }); });
}

TEST(ResidentMemoryTest, SortOfManyRuns) {
  SKIP_IF_SANITIZED;
  EXPECT_WITHIN_BUDGET([] {
    TestEngine engine({.budget_bytes = 64 << 10});
    std::mt19937 random;
    auto numbers = many<std::uint32_t>(
        engine, 2000000, [&](std::uint32_t) { return static_cast<std::uint32_t>(random()); });
    exit_by_growth(engine, [&] { sort_spill(engine, std::move(numbers), std::less<>()); });
  });
}

TEST(ResidentMemoryTest, GatherFromALargeTable) {
  SKIP_IF_SANITIZED;
  EXPECT_WITHIN_BUDGET([] {
    TestEngine engine({.budget_bytes = 64 << 10});
    auto table = many<std::uint64_t>(engine, 2000000, [](std::uint32_t i) { return i; });
    auto indices =
        many<std::uint32_t>(engine, 1000, [](std::uint32_t i) { return i * 7919 % 2000000; });
    exit_by_growth(engine, [&] { gather(engine, std::move(indices), table, std::uint64_t{0}); });
  });
}

TEST(ResidentMemoryTest, GatherToManyOutputs) {
  SKIP_IF_SANITIZED;
  EXPECT_WITHIN_BUDGET([] {
    TestEngine engine({.budget_bytes = 64 << 10});
    auto table = many<std::uint64_t>(engine, 10000, [](std::uint32_t i) { return i; });
    auto indices =
        many<std::uint32_t>(engine, 2000000, [](std::uint32_t i) { return i * 7919 % 10000; });
    exit_by_growth(engine, [&] { gather(engine, std::move(indices), table, std::uint64_t{0}); });
  });
}

TEST(ResidentMemoryTest, LabelsOfManyRanges) {
  SKIP_IF_SANITIZED;
  EXPECT_WITHIN_BUDGET([] {
    TestEngine engine({.budget_bytes = 1 << 20});
    constexpr std::uint32_t kNodes = 2000000;
    auto links = many<Link>(engine, kNodes - 1, [](std::uint32_t i) { return Link(i, i + 1); });
    exit_by_growth(engine,
                   [&] { label_nodes(engine, std::move(links), kNodes, LinkRule::kManifoldOnly); });
  });
}

TEST(ResidentMemoryTest, CacheOfManyPages) {
  SKIP_IF_SANITIZED;
  EXPECT_WITHIN_BUDGET([] {
    constexpr std::uint64_t kCacheBytes = 8 << 20;
    TestEngine engine({.budget_bytes = kCacheBytes});
    auto table = many<Position>(engine, 1000000, [](std::uint32_t i) {
      return Position{1.0 * i, 0, 0};
    });
    exit_by_growth(engine, [&] {
      PageCache<Position> cache(table, kCacheBytes);
      for (std::uint32_t i = 0; i < 1000000; ++i) cache.at(i);
    });
  });
}

}  // namespace
}  // namespace atlasgauge
