#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {

/// Calls use(worker, block, records) for every block of a spill, on all workers; takes a block of
/// memory each. `use` may free the block when it is done with it.
template <class T, class Use>
void visit_blocks(const Engine& engine, const Spill<T>& spill, Use use) {
  std::vector<BlockBuffer> buffers(engine.workers.count());
  std::vector<std::size_t> block_of(engine.workers.count());
  std::size_t next = 0;
  Workers::Pipeline pipeline;
  pipeline.produce = [&](std::size_t worker) {
    if (next == spill.block_count()) return false;
    block_of[worker] = next++;
    spill.read_ahead(next);
    return true;
  };
  pipeline.transform = [&](std::size_t worker) {
    const std::size_t block = block_of[worker];
    use(worker, block, spill.load(block, buffers[worker]));
  };
  engine.workers.run(pipeline);
}

}  // namespace atlasgauge
