#include "stream/engine/workers.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace atlasgauge {
namespace {

class WorkersTest : public testing::TestWithParam<std::size_t> {
 protected:
  Workers workers_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Counts, WorkersTest, testing::Values(1, 2, 3));

/// Numbers 0, 1, ... through a pipeline, with what happened to them.
struct Numbers {
  explicit Numbers(const Workers& workers, int count_)
      : count(count_), of_worker(workers.count(), -1) {
    pipeline.produce = [this](std::size_t worker) {
      if (static_cast<int>(produced.size()) == count) return false;
      of_worker[worker] = static_cast<int>(produced.size());
      produced.push_back(of_worker[worker]);
      most_under_way = std::max(most_under_way.load(), ++under_way);
      return true;
    };
    pipeline.transform = [this](std::size_t worker) {
      if (of_worker[worker] % 3 == 0) std::this_thread::yield();
      ++transformed;
    };
    pipeline.commit = [this](std::size_t worker) {
      committed.push_back(of_worker[worker]);
      --under_way;
    };
  }

  int count;
  std::vector<int> of_worker;
  std::vector<int> produced, committed;
  std::atomic<int> transformed{0};
  std::atomic<int> under_way{0}, most_under_way{0};
  Workers::Pipeline pipeline;
};

std::string error_of(const Workers& workers, const Workers::Pipeline& pipeline) {
  try {
    workers.run(pipeline);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST_P(WorkersTest, CommitsInTheOrderOfProduction) {
  Numbers numbers(workers_, 2000);
  workers_.run(numbers.pipeline);
  EXPECT_EQ(numbers.transformed, 2000);
  EXPECT_EQ(numbers.committed.size(), 2000U);
  EXPECT_EQ(numbers.committed, numbers.produced);
}

TEST_P(WorkersTest, AtMostOneItemAWorkerIsUnderWay) {
  Numbers numbers(workers_, 2000);
  workers_.run(numbers.pipeline);
  EXPECT_LE(numbers.most_under_way, static_cast<int>(GetParam()));
}

TEST_P(WorkersTest, NothingToProduceIsFine) {
  Numbers numbers(workers_, 0);
  workers_.run(numbers.pipeline);
  EXPECT_EQ(numbers.transformed, 0);
}

TEST_P(WorkersTest, ProduceIsNotAskedAgainAfterTheEnd) {
  std::atomic<int> asked{0};
  workers_.run({[&](std::size_t) {
                  ++asked;
                  return false;
                },
                [](std::size_t) {},
                {}});
  EXPECT_EQ(asked, 1);
}

TEST_P(WorkersTest, ErrorOfProduceStopsAndIsThrown) {
  Numbers numbers(workers_, 1 << 30);
  const auto produce = numbers.pipeline.produce;
  numbers.pipeline.produce = [&](std::size_t worker) {
    if (numbers.produced.size() == 50) throw std::runtime_error("cannot produce");
    return produce(worker);
  };
  EXPECT_EQ(error_of(workers_, numbers.pipeline), "cannot produce");
  EXPECT_EQ(numbers.produced.size(), 50U);
}

TEST_P(WorkersTest, ErrorOfTransformStopsAndIsThrown) {
  Numbers numbers(workers_, 1 << 30);
  numbers.pipeline.transform = [&](std::size_t worker) {
    if (numbers.of_worker[worker] == 50) throw std::runtime_error("cannot transform");
  };
  EXPECT_EQ(error_of(workers_, numbers.pipeline), "cannot transform");
  EXPECT_LE(numbers.committed.size(), 50U);
  EXPECT_LE(numbers.produced.size(), 50U + GetParam());
}

TEST_P(WorkersTest, ErrorOfCommitStopsAndIsThrown) {
  Numbers numbers(workers_, 1 << 30);
  const auto commit = numbers.pipeline.commit;
  numbers.pipeline.commit = [&](std::size_t worker) {
    if (numbers.of_worker[worker] == 50) throw std::runtime_error("cannot commit");
    commit(worker);
  };
  EXPECT_EQ(error_of(workers_, numbers.pipeline), "cannot commit");
  EXPECT_EQ(numbers.committed.size(), 50U);
}

TEST_P(WorkersTest, WorksAgainAfterAnError) {
  EXPECT_THROW(
      workers_.for_each(3, [](std::size_t, std::size_t) { throw std::runtime_error("x"); }),
      std::runtime_error);
  std::atomic<int> done{0};
  workers_.for_each(10, [&](std::size_t, std::size_t) { ++done; });
  EXPECT_EQ(done, 10);
}

TEST_P(WorkersTest, ForEachVisitsEveryItemOnce) {
  for (const std::size_t items : {0U, 1U, 2U, 500U}) {
    std::mutex mutex;
    std::multiset<std::size_t> seen;
    workers_.for_each(items, [&](std::size_t worker, std::size_t item) {
      EXPECT_LT(worker, GetParam());
      const std::lock_guard lock(mutex);
      seen.insert(item);
    });
    EXPECT_EQ(seen.size(), items);
    EXPECT_EQ(std::set<std::size_t>(seen.begin(), seen.end()).size(), items);
  }
}

TEST_P(WorkersTest, CountsTheItemsOfEachWorker) {
  workers_.for_each(100, [](std::size_t, std::size_t) {});
  std::uint64_t done = 0;
  for (std::size_t i = 0; i < GetParam(); ++i) done += workers_.items_done(i);
  EXPECT_EQ(done, 100U);
}

TEST_P(WorkersTest, AllWorkersAreBusyAtOnce) {
  std::atomic<std::size_t> there{0};
  workers_.for_each(GetParam(), [&](std::size_t, std::size_t) {
    ++there;
    while (there < GetParam()) std::this_thread::yield();
  });
  for (std::size_t i = 0; i < GetParam(); ++i) EXPECT_EQ(workers_.items_done(i), 1U);
}

TEST(WorkersCountTest, ThereIsAlwaysOne) {
  EXPECT_EQ(Workers(0).count(), 1U);
}

}  // namespace
}  // namespace atlasgauge
