#include "io/draco/allocation_limit.hpp"

#include <gtest/gtest.h>

#include <new>
#include <string>
#include <thread>
#include <vector>

namespace atlasgauge {
namespace {

TEST(AllocationLimit, RefusesWhatWouldBeTooMuchAtOnce) {
  const AllocationLimit limit(10000);
  EXPECT_NO_THROW(std::vector<char>(9000));
  EXPECT_NO_THROW(std::vector<char>(9000)) << "the first was freed";
  EXPECT_FALSE(limit.was_reached());
  const std::vector<char> held(6000);
  EXPECT_THROW(std::vector<char>(6000), std::bad_alloc);
  EXPECT_TRUE(limit.was_reached());
}

TEST(AllocationLimit, IsThatOfItsThreadAndItsScope) {
  {
    const AllocationLimit limit(100000);
    std::size_t elsewhere = 0;
    std::thread([&] { elsewhere = std::vector<char>(1 << 20).size(); }).join();
    EXPECT_EQ(elsewhere, std::size_t{1} << 20);
    EXPECT_FALSE(limit.was_reached());
  }
  EXPECT_NO_THROW(std::vector<char>(1 << 20));
}

}  // namespace
}  // namespace atlasgauge
