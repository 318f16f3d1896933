#include "stream/engine/transfer_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace atlasgauge {
namespace {

constexpr std::size_t kBlock = 4096;

/// A disk in memory that can be stopped, and that fails on demand.
class FakeDisk {
 public:
  TransferQueue::Device device() {
    return {[this](std::uint32_t block, const std::byte* from, std::size_t bytes) {
              const OneWrite only(*this, block);
              wait();
              if (fails) throw std::runtime_error("disk full");
              const std::lock_guard lock(mutex_);
              blocks_[block].assign(from, from + bytes);
              ++writes;
            },
            [this](std::uint32_t block, std::byte* to, std::size_t) {
              wait();
              if (fails) {
                ++failures;
                throw std::runtime_error("no such sector");
              }
              const std::lock_guard lock(mutex_);
              const std::vector<std::byte>& bytes = blocks_.at(block);
              std::memcpy(to, bytes.data(), bytes.size());
              ++reads;
            }};
  }
  void stop() { set_stopped(true); }
  void go() { set_stopped(false); }
  int first_byte(std::uint32_t block) {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(blocks_.at(block).at(0));
  }

  /// Writes that began while another of the same block was under way.
  int overlaps() {
    const std::lock_guard lock(mutex_);
    return overlaps_;
  }

  std::atomic<bool> fails{false};
  std::atomic<int> writes{0}, reads{0}, failures{0};
  std::atomic<int> writes_begun{0};

 private:
  class OneWrite {
   public:
    OneWrite(FakeDisk& disk, std::uint32_t block) : disk_(disk), block_(block) {
      const std::lock_guard lock(disk_.mutex_);
      if (!disk_.in_writing_.insert(block).second) ++disk_.overlaps_;
      ++disk_.writes_begun;
    }
    ~OneWrite() {
      const std::lock_guard lock(disk_.mutex_);
      disk_.in_writing_.erase(block_);
    }
    OneWrite(const OneWrite&) = delete;
    OneWrite& operator=(const OneWrite&) = delete;

   private:
    FakeDisk& disk_;
    std::uint32_t block_;
  };

  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !stopped_; });
  }
  void set_stopped(bool stopped) {
    const std::lock_guard lock(mutex_);
    stopped_ = stopped;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopped_ = false;
  std::set<std::uint32_t> in_writing_;
  int overlaps_ = 0;
  std::map<std::uint32_t, std::vector<std::byte>> blocks_;
};

class TransferQueueTest : public testing::Test {
 protected:
  void write(std::uint32_t block, int value) {
    BlockBytes bytes = memory_.lend();
    std::memset(bytes.data(), value, kBlock);
    queue_.write(block, bytes, kBlock);
  }
  /// -1 if it was not read ahead.
  int take(std::uint32_t block) {
    BlockBytes bytes = memory_.lend();
    return queue_.take(block, bytes) ? static_cast<int>(bytes.data()[0]) : -1;
  }
  void wait_for_reads(int count) {
    while (disk_.reads < count) std::this_thread::yield();
  }

  FakeDisk disk_;
  BlockMemory memory_{kBlock};
  TransferQueue queue_{6, memory_, disk_.device()};
};

TEST_F(TransferQueueTest, WhatIsHandedInIsWritten) {
  for (std::uint32_t block = 0; block < 20; ++block) write(block, static_cast<int>(block));
  for (std::uint32_t block = 0; block < 20; ++block) {
    queue_.settle(block);
    EXPECT_EQ(disk_.first_byte(block), static_cast<int>(block));
  }
}

TEST_F(TransferQueueTest, WritersGoOnWhileTheDiskIsBusy) {
  disk_.stop();
  for (std::uint32_t block = 0; block < 3; ++block) write(block, 1);
  EXPECT_EQ(disk_.writes, 0);
  disk_.go();
}

TEST_F(TransferQueueTest, ABlockReadAheadIsTakenWithoutAnotherRead) {
  write(7, 42);
  queue_.settle(7);
  queue_.read_ahead(7, kBlock);
  wait_for_reads(1);
  EXPECT_EQ(take(7), 42);
  EXPECT_EQ(take(7), -1);
  EXPECT_EQ(disk_.reads, 1);
}

TEST_F(TransferQueueTest, ABlockIsNotReadWhileItIsWritten) {
  disk_.stop();
  write(7, 42);
  queue_.read_ahead(7, kBlock);
  std::atomic<int> taken{0};
  std::jthread reader([&] { taken = take(7); });
  EXPECT_EQ(taken, 0);
  disk_.go();
  reader.join();
  EXPECT_EQ(taken, -1);
  EXPECT_EQ(disk_.first_byte(7), 42);
}

TEST_F(TransferQueueTest, AFreedBlockIsNotWrittenOverByItsFormerOwner) {
  for (int i = 0; i < 200; ++i) {
    write(7, 1);
    queue_.forget(7);
    write(7, 2);
    queue_.settle(7);
    ASSERT_EQ(disk_.first_byte(7), 2);
  }
}

TEST_F(TransferQueueTest, ABlockIsNotWrittenTwiceAtATime) {
  disk_.stop();
  write(7, 1);
  while (disk_.writes_begun == 0) std::this_thread::yield();
  queue_.forget(7);
  std::jthread next_owner([&] { write(7, 2); });
  const auto patience = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
  while (disk_.writes_begun < 2 && std::chrono::steady_clock::now() < patience) {
    std::this_thread::yield();
  }
  disk_.go();
  next_owner.join();
  queue_.settle(7);
  EXPECT_EQ(disk_.overlaps(), 0);
  EXPECT_EQ(disk_.first_byte(7), 2);
}

TEST_F(TransferQueueTest, AFreedBlockIsNotTakenAsItWas) {
  write(7, 1);
  queue_.settle(7);
  queue_.read_ahead(7, kBlock);
  queue_.forget(7);
  write(7, 2);
  queue_.settle(7);
  EXPECT_EQ(take(7), -1);
}

TEST_F(TransferQueueTest, WhatNobodyTakesMakesRoomInTheEnd) {
  for (std::uint32_t block = 0; block < 3; ++block) {
    write(block, 1);
    queue_.settle(block);
    queue_.read_ahead(block, kBlock);
    wait_for_reads(static_cast<int>(block) + 1);
  }
  write(9, 42);
  queue_.settle(9);
  queue_.read_ahead(9, kBlock);  // no room yet
  EXPECT_EQ(take(9), -1);
  for (int i = 0; i < 60; ++i) write(8, 1);
  queue_.read_ahead(9, kBlock);
  wait_for_reads(4);
  EXPECT_EQ(take(9), 42);
}

TEST_F(TransferQueueTest, AFailedWriteIsThrownAtTheNextCaller) {
  disk_.fails = true;
  write(7, 1);
  EXPECT_THROW(queue_.settle(7), std::runtime_error);
  EXPECT_THROW(write(8, 1), std::runtime_error);
}

TEST_F(TransferQueueTest, AFailedReadAheadIsThrownAtWhoTakesTheBlock) {
  write(7, 1);
  queue_.settle(7);
  disk_.fails = true;
  queue_.read_ahead(7, kBlock);
  while (disk_.failures == 0) std::this_thread::yield();
  EXPECT_THROW(take(7), std::runtime_error);
  disk_.fails = false;
  EXPECT_EQ(take(7), -1);
}

TEST_F(TransferQueueTest, AFailedReadAheadThatNobodyWantsHarmsNobody) {
  write(7, 1);
  queue_.settle(7);
  disk_.fails = true;
  queue_.read_ahead(7, kBlock);
  queue_.forget(7);
  disk_.fails = false;
  write(7, 2);
  queue_.settle(7);
  EXPECT_EQ(disk_.first_byte(7), 2);
}

TEST_F(TransferQueueTest, ManyOwnersOfManyBlocksDoNotMeet) {
  std::atomic<int> wrong{0};
  const auto own = [&](std::uint32_t first) {
    for (int round = 0; round < 300; ++round) {
      const std::uint32_t block = first + static_cast<std::uint32_t>(round) % 5;
      write(block, round % 100);
      if (round % 3 == 0) queue_.settle(block);
      queue_.read_ahead(block, kBlock);
      const int taken = take(block);
      if (taken != -1 && taken != round % 100) ++wrong;
      if (disk_.first_byte(block) != round % 100) ++wrong;
      queue_.forget(block);
    }
  };
  {
    std::vector<std::jthread> owners;
    for (std::uint32_t i = 0; i < 4; ++i) owners.emplace_back(own, 10 * i);
  }
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace atlasgauge
