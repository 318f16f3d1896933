#include "stream/engine/transfer_queue.hpp"

#include <algorithm>
#include <utility>

#include "io/file/held_signals.hpp"

namespace atlasgauge {

TransferQueue::TransferQueue(std::size_t slots, BlockMemory& memory, Device device)
    : memory_(memory), device_(std::move(device)), slots_(std::max<std::size_t>(2, slots)) {
  const HeldSignals inherited_by_threads;
  try {
    for (std::size_t i = 0; i < kThreads; ++i) threads_.emplace_back([this] { run(); });
  } catch (...) {
    stop();
    throw;
  }
}

TransferQueue::~TransferQueue() {
  stop();
}

void TransferQueue::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  work_.notify_all();
}

void TransferQueue::write(BlockId block, BlockBytes& memory, std::size_t bytes) {
  Lock lock(mutex_);
  settle(block, lock);
  Slot* slot = nullptr;
  progress_.wait(lock, [&] {
    slot = free_slot(0, slots_.size() / 2);
    return slot != nullptr || error_ != nullptr;
  });
  if (error_) std::rethrow_exception(error_);
  std::swap(slot->memory, memory);
  enqueue(*slot, block, bytes);
}

void TransferQueue::read_ahead(BlockId block, std::size_t bytes) {
  const Lock lock(mutex_);
  if (find(block) != nullptr) return;
  Slot* slot = free_slot(slots_.size() / 2, slots_.size());
  if (slot == nullptr) slot = stale_read();
  if (slot != nullptr) enqueue(*slot, block, bytes);
}

bool TransferQueue::take(BlockId block, BlockBytes& memory) {
  Lock lock(mutex_);
  settle(block, lock);
  Slot* slot = nullptr;
  progress_.wait(lock, [&] {
    slot = find(block);
    return slot == nullptr || slot->state != State::kUnderWay;
  });
  if (slot == nullptr) return false;
  if (slot->state == State::kRead) std::swap(slot->memory, memory);
  if (slot->state == State::kFailed) {
    slot->state = State::kFree;
    std::rethrow_exception(std::exchange(slot->error, nullptr));
  }
  return std::exchange(slot->state, State::kFree) == State::kRead;
}

void TransferQueue::settle(BlockId block) {
  Lock lock(mutex_);
  settle(block, lock);
}

void TransferQueue::settle(BlockId block, Lock& lock) {
  progress_.wait(lock, [&] {
    const Slot* const slot = find(block);
    return error_ != nullptr || slot == nullptr || !is_write(*slot);
  });
  if (error_) std::rethrow_exception(error_);
}

void TransferQueue::forget(BlockId block) noexcept {
  const Lock lock(mutex_);
  Slot* const slot = find(block);
  if (slot == nullptr) return;
  if (slot->state != State::kUnderWay) {
    slot->state = State::kFree;
    progress_.notify_all();
  } else if (!is_write(*slot)) {
    slot->forgotten = true;
  }
}

bool TransferQueue::is_write(const Slot& slot) const {
  return static_cast<std::size_t>(&slot - slots_.data()) < slots_.size() / 2;
}

/// The transfer of a block; there is at most one that is not forgotten.
TransferQueue::Slot* TransferQueue::find(BlockId block) {
  const auto slot = std::find_if(slots_.begin(), slots_.end(), [&](const Slot& s) {
    return s.state != State::kFree && !s.forgotten && s.block == block;
  });
  return slot == slots_.end() ? nullptr : &*slot;
}

/// A free one of the slots [first, end), with memory.
TransferQueue::Slot* TransferQueue::free_slot(std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    if (slots_[i].state != State::kFree) continue;
    if (!slots_[i].memory) slots_[i].memory = memory_.lend();
    return &slots_[i];
  }
  return nullptr;
}

TransferQueue::Slot* TransferQueue::oldest(State state) {
  Slot* oldest = nullptr;
  for (Slot& slot : slots_) {
    if (slot.state == state && (oldest == nullptr || slot.turn < oldest->turn)) oldest = &slot;
  }
  return oldest;
}

TransferQueue::Slot* TransferQueue::stale_read() {
  Slot* const slot = oldest(State::kRead);
  return slot != nullptr && slot->turn + 8 * slots_.size() < next_turn_ ? slot : nullptr;
}

void TransferQueue::enqueue(Slot& slot, BlockId block, std::size_t bytes) {
  slot.state = State::kWaiting;
  slot.forgotten = false;
  slot.block = block;
  slot.bytes = bytes;
  slot.turn = next_turn_++;
  work_.notify_one();
}

/// One thread.
void TransferQueue::run() {
  Lock lock(mutex_);
  while (true) {
    Slot* slot = nullptr;
    work_.wait(lock, [&] { return stopped_ || (slot = oldest(State::kWaiting)) != nullptr; });
    if (stopped_) return;
    transfer(*slot, lock);
    progress_.notify_all();
  }
}

void TransferQueue::transfer(Slot& slot, Lock& lock) {
  slot.state = State::kUnderWay;
  lock.unlock();
  std::exception_ptr error;
  try {
    if (is_write(slot)) {
      device_.write(slot.block, slot.memory.data(), slot.bytes);
    } else {
      device_.read(slot.block, slot.memory.data(), slot.bytes);
    }
  } catch (...) {
    error = std::current_exception();
  }
  lock.lock();
  if (is_write(slot) || slot.forgotten) {
    slot.state = State::kFree;
    if (is_write(slot) && error) error_ = error;
    return;
  }
  slot.state = error ? State::kFailed : State::kRead;
  slot.error = std::move(error);
}

}  // namespace atlasgauge
