#pragma once

#include <cstddef>
#include <cstdint>

#include "stream/engine/budget.hpp"
#include "stream/engine/scratch.hpp"
#include "stream/engine/stage_log.hpp"
#include "stream/engine/workers.hpp"

namespace atlasgauge {

/// What every stage works with.
struct Engine {
  MemoryBudget& budget;
  Scratch& scratch;
  const Workers& workers;
  StageLog& log;

  std::size_t block_bytes() const { return scratch.block_bytes(); }
};

}  // namespace atlasgauge
