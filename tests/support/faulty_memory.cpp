// Preloaded into a program (LD_PRELOAD) to give it no memory: once it has opened a file whose name
// ends with FAULTY_MEMORY_AFTER, the allocation FAULTY_MEMORY_FIRST (from 1) of at least
// FAULTY_MEMORY_BYTES bytes, and the FAULTY_MEMORY_COUNT - 1 after it, return null.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdlib>
#include <string_view>

// What glibc's allocator is behind its public names; dlsym would allocate.
extern "C" void* __libc_malloc(size_t bytes);                      // NOLINT
extern "C" void* __libc_memalign(size_t alignment, size_t bytes);  // NOLINT

namespace {

std::size_t number(const char* name, std::size_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

std::atomic<bool> armed{false};
std::atomic<std::size_t> allocations{0};

bool refused(std::size_t bytes) {
  static const std::size_t least_bytes = number("FAULTY_MEMORY_BYTES", 1);
  static const std::size_t first = number("FAULTY_MEMORY_FIRST", 1);
  static const std::size_t count = number("FAULTY_MEMORY_COUNT", 1);
  if (!armed || bytes < least_bytes) return false;
  const std::size_t allocation = ++allocations;
  const bool refuse = allocation >= first && allocation - first < count;
  if (refuse) errno = ENOMEM;
  return refuse;
}

}  // namespace

extern "C" {

void* malloc(size_t bytes) {
  return refused(bytes) ? nullptr : __libc_malloc(bytes);
}

void* aligned_alloc(size_t alignment, size_t bytes) {
  return refused(bytes) ? nullptr : __libc_memalign(alignment, bytes);
}

int open(const char* path, int flags, ...) {
  static const auto real =
      reinterpret_cast<int (*)(const char*, int, ...)>(::dlsym(RTLD_NEXT, "open"));
  va_list arguments;
  va_start(arguments, flags);
  const bool has_mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  const mode_t mode = has_mode ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  const char* after = std::getenv("FAULTY_MEMORY_AFTER");
  if (after != nullptr && std::string_view(path).ends_with(after)) armed = true;
  return real(path, flags, mode);
}

}  // extern "C"
