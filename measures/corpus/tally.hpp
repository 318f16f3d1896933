#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>

#include "io/corpus/model_result.hpp"

namespace atlasgauge {

/// How many models have which result.
struct Tally {
  std::size_t measured = 0, failed = 0, missing = 0;

  void add(const std::optional<ModelResult>& result) {
    ++(!result ? missing : result->measured ? measured : failed);
  }
  std::size_t models() const { return measured + failed + missing; }
  std::string text() const {
    return fmt::format("{} measured, {} failed, {} missing", measured, failed, missing);
  }
};

}  // namespace atlasgauge
