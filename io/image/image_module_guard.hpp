#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <string>

namespace atlasgauge {

/// How functions of the image module fail: `work` returns the fault, or an empty text.
template <class Work>
bool tell_fault(Work work, char* error, std::size_t error_bytes) {
  std::string fault;
  try {
    fault = work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    fault = e.what();
    if (fault.empty()) fault = "unknown reason";
  }
  if (fault.empty()) return true;
  if (error_bytes == 0) return false;
  const std::size_t bytes = std::min(fault.size(), error_bytes - 1);
  std::memcpy(error, fault.data(), bytes);
  error[bytes] = '\0';
  return false;
}

}  // namespace atlasgauge
