#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {

/// Enough that taking turns costs little, few enough for the caches.
constexpr std::size_t kMostRowsPerItem = 8192;

/// Reads spills of equal length side by side and calls use(worker, first_row, records...) with a
/// span of each, on all workers, in no order. Takes a block of memory for each spill and each
/// worker.
template <class Use, class... Records>
void visit_rows(const Engine& engine, Use use, const Spill<Records>&... spills) {
  struct Item {
    std::uint64_t first_row = 0;
    std::tuple<std::vector<Records>...> columns;
  };
  std::vector<Item> items(engine.workers.count());
  std::tuple<SpillReader<Records>...> readers{SpillReader<Records>(spills)...};
  constexpr std::size_t kRowBytes = (sizeof(Records) + ...);
  const std::size_t rows_per_item =
      std::clamp<std::size_t>(engine.block_bytes() / kRowBytes, 1, kMostRowsPerItem);
  const std::uint64_t rows = std::min({spills.size()...});
  std::uint64_t next_row = 0;
  const auto read = [&](auto& reader, auto& column) {
    column.resize(std::min<std::uint64_t>(rows_per_item, rows - next_row));
    reader.read(std::span(column));
  };
  Workers::Pipeline pipeline;
  pipeline.produce = [&](std::size_t worker) {
    if (next_row == rows) return false;
    Item& item = items[worker];
    item.first_row = next_row;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (read(std::get<I>(readers), std::get<I>(item.columns)), ...);
    }
    (std::index_sequence_for<Records...>{});
    next_row += std::get<0>(item.columns).size();
    return true;
  };
  pipeline.transform = [&](std::size_t worker) {
    const Item& item = items[worker];
    std::apply([&](const auto&... columns) { use(worker, item.first_row, std::span(columns)...); },
               item.columns);
  };
  engine.workers.run(pipeline);
}

}  // namespace atlasgauge
