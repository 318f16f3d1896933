#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {

struct EngineOptions {
  std::uint64_t budget_bytes = 64 << 20;
  std::size_t block_bytes = 4096;
  std::size_t workers = 2;
  std::uint64_t resident_bytes = 0;
  std::size_t queued_blocks = 4;  ///< beside budget_bytes
  std::string directory = std::filesystem::temp_directory_path().string();
};

/// An engine of any size, with all that it refers to.
class TestEngine {
 public:
  explicit TestEngine(const EngineOptions& options = {})
      : budget(options.budget_bytes - options.resident_bytes),
        scratch_budget(options.resident_bytes + options.queued_blocks * options.block_bytes),
        scratch(
            {options.directory, options.block_bytes, options.resident_bytes, options.queued_blocks},
            scratch_budget),
        workers(options.workers),
        log(scratch, workers),
        engine{budget, scratch, workers, log} {}
  TestEngine(const TestEngine&) = delete;
  TestEngine& operator=(const TestEngine&) = delete;

  operator const Engine&() const { return engine; }

  MemoryBudget budget, scratch_budget;
  Scratch scratch;
  Workers workers;
  StageLog log;
  Engine engine;
};

template <class T>
Spill<T> spill_of(TestEngine& engine, const std::vector<T>& records) {
  SpillWriter<T> writer(engine.scratch);
  writer.append(records);
  return writer.finish();
}

template <class T>
std::vector<T> records_of(Spill<T>& spill) {
  std::vector<T> records(spill.size());
  SpillReader<T>(spill).read(records);
  return records;
}

template <class T>
std::vector<T> records_of(Spill<T>&& spill) {
  return records_of(spill);
}

}  // namespace atlasgauge
