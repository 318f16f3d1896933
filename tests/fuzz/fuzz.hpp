#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

/// What libFuzzer calls with every input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes);

namespace atlasgauge::fuzz {

/// Ends the process, which makes the input a finding.
inline void require(bool holds, const std::string& claim) {
  if (holds) return;
  std::fprintf(stderr, "NOT TRUE: %s\n", claim.c_str());
  std::abort();
}

}  // namespace atlasgauge::fuzz
