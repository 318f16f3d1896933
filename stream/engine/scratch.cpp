#include "stream/engine/scratch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// A file that has no name from the start, or loses it at once where the file system needs one.
int open_unnamed(const std::string& directory, int flags) {
  const int file = ::open(directory.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC | flags, 0600);
  if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR)) return file;
  std::string name = directory + "/atlasgauge-XXXXXX";
  const int named = ::mkostemp(name.data(), O_CLOEXEC | flags);
  const int reason = errno;
  ::unlink(name.c_str());  // even a refused O_DIRECT may have made it
  errno = reason;
  return named;
}

}  // namespace

Scratch::Scratch(const Options& options, MemoryBudget& budget)
    : directory_(options.directory),
      block_bytes_(AlignedBytes::rounded_up(options.block_bytes)),
      resident_blocks_(static_cast<std::uint32_t>(options.resident_bytes / block_bytes_)),
      queued_blocks_(options.queued_blocks),
      memory_(block_bytes_) {
  free_resident_.reserve(resident_blocks_);
  if (queued_blocks_ > 0) {
    queue_reservation_ = budget.reserve(queued_blocks_ * block_bytes_, "transfers of scratch");
  }
  if (resident_blocks_ == 0) return;
  const std::uint64_t pool_bytes = std::uint64_t{resident_blocks_} * block_bytes_;
  pool_reservation_ = budget.reserve(pool_bytes, "the resident part of scratch");
  pool_ = AlignedBytes(pool_bytes);
}

void Scratch::open_file() {
  file_ = Descriptor(open_unnamed(directory_, O_DIRECT));
  if (!file_ && errno == EINVAL) file_ = Descriptor(open_unnamed(directory_, 0));
  if (!file_) {
    throw Error(ErrorKind::kResource, directory_, 0,
                "cannot make a scratch file: " + errno_text() +
                    "; give a writable directory with --tmp-dir");
  }
  if (queued_blocks_ > 0) start_queue();
}

/// Where the system gives no more threads, all transfers are done at once.
void Scratch::start_queue() {
  const TransferQueue::Device device{
      [this](BlockId block, const std::byte* from, std::size_t bytes) {
        write_now(block, from, bytes);
      },
      [this](BlockId block, std::byte* to, std::size_t bytes) { read_now(block, 0, to, bytes); }};
  try {
    owned_queue_ = std::make_unique<TransferQueue>(queued_blocks_, memory_, device);
    queue_ = owned_queue_.get();
  } catch (const std::system_error&) {
    return;
  }
}

Scratch::BlockId Scratch::allocate() {
  const std::lock_guard lock(mutex_);
  peak_blocks_ = std::max(peak_blocks_, ++live_blocks_);
  const auto take = [](std::vector<BlockId>& list) {
    const BlockId block = list.back();
    list.pop_back();
    return block;
  };
  if (!free_resident_.empty()) return take(free_resident_);
  if (next_resident_ < resident_blocks_) return next_resident_++;
  ++spilled_blocks_;
  if (!free_on_disk_.empty()) return take(free_on_disk_);
  if (!file_) open_file();
  make_room_for_freed_blocks();
  return resident_blocks_ + next_on_disk_++;
}

/// Blocks are freed while errors pass, when memory may be what there is too little of.
void Scratch::make_room_for_freed_blocks() {
  const std::size_t blocks = std::size_t{next_on_disk_} + 1;
  if (free_on_disk_.capacity() < blocks) free_on_disk_.reserve(2 * blocks);
}

void Scratch::free(BlockId block) noexcept {
  TransferQueue* const queue = queue_;
  if (block >= resident_blocks_ && queue != nullptr) queue->forget(block);
  const std::lock_guard lock(mutex_);
  --live_blocks_;
  (block < resident_blocks_ ? free_resident_ : free_on_disk_).push_back(block);
}

std::byte* Scratch::resident(BlockId block) const {
  if (block >= resident_blocks_) return nullptr;
  return pool_.data() + std::uint64_t{block} * block_bytes_;
}

std::uint64_t Scratch::file_offset(BlockId block) const {
  return std::uint64_t{block - resident_blocks_} * block_bytes_;
}

/// Calls transfer(done), which reads or writes on from there, until `bytes` are done.
template <class Transfer>
void Scratch::transfer_all(std::size_t bytes, const char* what, Transfer transfer) const {
  bool may_be_misaligned = true;
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t n = transfer(done);
    if (n > 0) {
      done += static_cast<std::size_t>(n);
    } else if (n < 0 && errno == EINVAL && std::exchange(may_be_misaligned, false)) {
      leave_direct_io();
    } else if (n == 0 || errno != EINTR) {
      throw Error(ErrorKind::kResource, directory_, 0,
                  fmt::format("cannot {} ({} MiB of scratch in use): {}; free space there or give "
                              "another directory with --tmp-dir",
                              what, peak_bytes() >> 20, n == 0 ? "it is cut short" : errno_text()));
    }
  }
}

/// Ordinary I/O from here on: a transfer stopped between two units of direct I/O, or the file
/// system wants larger units.
void Scratch::leave_direct_io() const {
  ::fcntl(file_.get(), F_SETFL, ::fcntl(file_.get(), F_GETFL) & ~O_DIRECT);
}

void Scratch::write(BlockId block, const std::byte* from, std::size_t bytes) {
  written_bytes_ += AlignedBytes::rounded_up(bytes);
  if (TransferQueue* const queue = queue_) queue->settle(block);
  write_now(block, from, bytes);
}

void Scratch::read(BlockId block, std::size_t offset, std::byte* to, std::size_t bytes) const {
  read_bytes_ += AlignedBytes::rounded_up(bytes);
  if (TransferQueue* const queue = queue_) queue->settle(block);
  read_now(block, offset, to, bytes);
}

void Scratch::write_behind(BlockId block, BlockBytes& memory, std::size_t bytes) {
  TransferQueue* const queue = queue_;
  if (queue == nullptr) return write(block, memory.data(), bytes);
  written_bytes_ += AlignedBytes::rounded_up(bytes);
  queue->write(block, memory, bytes);
}

void Scratch::read_ahead(BlockId block, std::size_t bytes) {
  TransferQueue* const queue = queue_;
  if (block >= resident_blocks_ && queue != nullptr) queue->read_ahead(block, bytes);
}

void Scratch::load(BlockId block, BlockBytes& memory, std::size_t bytes) {
  read_bytes_ += AlignedBytes::rounded_up(bytes);
  TransferQueue* const queue = queue_;
  if (queue != nullptr && queue->take(block, memory)) return;
  read_now(block, 0, memory.data(), bytes);
}

void Scratch::write_now(BlockId block, const std::byte* from, std::size_t bytes) {
  const std::size_t size = AlignedBytes::rounded_up(bytes);
  transfer_all(size, "write scratch", [&](std::size_t done) {
    return ::pwrite(file_.get(), from + done, size - done,
                    static_cast<off_t>(file_offset(block) + done));
  });
}

void Scratch::read_now(BlockId block, std::size_t offset, std::byte* to, std::size_t bytes) const {
  const std::size_t size = AlignedBytes::rounded_up(bytes);
  transfer_all(bytes, "read scratch back", [&](std::size_t done) {
    return ::pread(file_.get(), to + done, size - done,
                   static_cast<off_t>(file_offset(block) + offset + done));
  });
}

std::uint64_t Scratch::room_bytes() const {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(directory_, error);
  if (error) return ~std::uint64_t{0};
  const std::lock_guard lock(mutex_);
  return (std::uint64_t{resident_blocks_} + next_on_disk_) * block_bytes_ + space.available;
}

std::uint64_t Scratch::peak_bytes() const {
  const std::lock_guard lock(mutex_);
  return peak_blocks_ * block_bytes_;
}

std::uint64_t Scratch::spilled_bytes() const {
  const std::lock_guard lock(mutex_);
  return spilled_blocks_ * block_bytes_;
}

}  // namespace atlasgauge
