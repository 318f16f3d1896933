#include "stream/engine/budget.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

std::string refusal_of(MemoryBudget& budget, std::uint64_t bytes, const std::string& who) {
  try {
    const Reservation reservation = budget.reserve(bytes, who);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    return error.what();
  }
  return "no refusal";
}

TEST(BudgetTest, ReservesUpToTheLastByte) {
  MemoryBudget budget(100);
  const Reservation all = budget.reserve(100, "all");
  EXPECT_EQ(all.bytes(), 100U);
  EXPECT_EQ(budget.free_bytes(), 0U);
}

TEST(BudgetTest, GivesBackWhenTheReservationDies) {
  MemoryBudget budget(100);
  { const Reservation some = budget.reserve(60, "some"); }
  EXPECT_EQ(budget.free_bytes(), 100U);
  EXPECT_EQ(budget.peak_bytes(), 60U);
}

TEST(BudgetTest, RefusalNamesTheHolderAndTheNeed) {
  MemoryBudget budget(4 * kMiB);
  const Reservation held = budget.reserve(3 * kMiB, "held");
  const std::string text = refusal_of(budget, 3 * kMiB, "sorting pebbles");
  EXPECT_EQ(text,
            "sorting pebbles needs 3072 KiB of working memory, but 3072 of 4096 KiB are in use; "
            "raise --memory by at least 3 MiB");
}

TEST(BudgetTest, WhatTheRefusalAsksForWouldDo) {
  MemoryBudget tight(2 * kMiB), raised(2 * kMiB + 3 * kMiB);
  EXPECT_NE(refusal_of(tight, 4 * kMiB + 1, "x").find("by at least 3 MiB"), std::string::npos);
  EXPECT_EQ(refusal_of(raised, 4 * kMiB + 1, "x"), "no refusal");
}

TEST(BudgetTest, RefusalLeavesTheAccountAsItWas) {
  MemoryBudget budget(10);
  refusal_of(budget, 11, "x");
  EXPECT_EQ(budget.free_bytes(), 10U);
  EXPECT_EQ(budget.peak_bytes(), 0U);
}

TEST(BudgetTest, RangeTakesWhatIsFreeWithinItsBounds) {
  MemoryBudget budget(100);
  EXPECT_EQ(budget.reserve_between(10, 40, "x").bytes(), 40U);
  EXPECT_EQ(budget.reserve_between(10, 400, "x").bytes(), 100U);
  EXPECT_EQ(budget.reserve_between(30, 20, "x").bytes(), 30U);
  EXPECT_THROW(budget.reserve_between(101, 400, "x"), Error);
}

TEST(BudgetTest, MovedReservationIsGivenBackOnce) {
  MemoryBudget budget(100);
  {
    Reservation first = budget.reserve(30, "first");
    Reservation second = std::move(first);
    EXPECT_EQ(first.bytes(), 0U);
    EXPECT_EQ(second.bytes(), 30U);
    EXPECT_EQ(budget.free_bytes(), 70U);
  }
  EXPECT_EQ(budget.free_bytes(), 100U);
}

TEST(BudgetTest, AssignmentGivesBackWhatWasHeld) {
  MemoryBudget budget(100);
  Reservation held = budget.reserve(30, "x");
  held = budget.reserve(50, "y");
  EXPECT_EQ(budget.free_bytes(), 50U);
  EXPECT_EQ(budget.peak_bytes(), 80U);
}

TEST(BudgetTest, ReleaseTwiceGivesBackOnce) {
  MemoryBudget budget(100);
  Reservation held = budget.reserve(30, "x");
  held.release();
  held.release();
  EXPECT_EQ(budget.free_bytes(), 100U);
}

TEST(BudgetTest, ThreadsShareOneAccount) {
  MemoryBudget budget(1000);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 3; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < 2000; ++k) budget.reserve(300, "thread").release();
      });
    }
  }
  EXPECT_EQ(budget.free_bytes(), 1000U);
  EXPECT_LE(budget.peak_bytes(), 900U);
}

}  // namespace
}  // namespace atlasgauge
