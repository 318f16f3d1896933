#include "stream/seams/texel_answers.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "stream/engine/partition.hpp"
#include "stream/seams/footprint_requests.hpp"

namespace atlasgauge {
namespace {

using Requests = KeyedGroups<TexelRequest>;
using Answers = KeyedGroups<TexelAnswer>;

/// What one worker answers with.
struct Answerer {
  TileWindow tiles;
  Partition<TexelAnswer>::Writer answers;

  void answer(std::span<const TexelRequest> requests, const KeyRanges& ranges) {
    const LoadedTile tile = tiles.at(requests[0].tile);
    for (const TexelRequest& request : requests) {
      answers.push(ranges.bucket_of(request.part.seam), answer_to(request, tile));
    }
  }
};

/// How far to read ahead. Reading a few hundred kilobytes costs little more than reading a tile,
/// but only where most tiles are wanted.
std::uint64_t window_pages(std::uint64_t requests, std::uint64_t tiles) {
  constexpr std::uint64_t kMostPages = 192;
  return tiles == 0 ? 1 : std::min(kMostPages, kMostPages * requests / tiles);
}

std::uint64_t count(const Requests::Buckets& requests) {
  std::uint64_t records = 0;
  for (const Spill<TexelRequest>& bucket : requests.spills) records += bucket.size();
  return records;
}

}  // namespace

Answers::Buckets answer_requests(const Engine& engine, const TexelStore& store,
                                 Requests::Buckets requests, std::uint64_t edges) {
  const std::size_t workers = engine.workers.count();
  const std::uint64_t free_bytes = engine.budget.free_bytes();
  const std::uint64_t requested = count(requests);
  if (requested == 0) return {};
  StageLog::Stage stage(engine.log, "seam answers", requests.spills.size());
  const std::uint64_t affordable = free_bytes / 8 / workers / sizeof(TexelPage);
  const std::uint64_t pages =
      std::max(store.largest_tile_pages(),
               std::min(affordable, window_pages(requested, store.tile_count())));
  const KeyRanges ranges =
      Answers::plan(engine, requested, 0, static_cast<std::uint32_t>(edges), free_bytes / 8 * 7,
                    free_bytes / 2, Answers::even_buckets(engine));
  const Reservation memory = engine.budget.reserve(
      Partition<TexelAnswer>::memory_bytes(ranges.bucket_count(), workers, engine.block_bytes()) +
          workers * pages * sizeof(TexelPage),
      "distributing texels to seams");
  Partition<TexelAnswer> partition(engine.scratch, ranges.bucket_count());
  std::vector<Answerer> answerers;
  for (std::size_t i = 0; i < workers; ++i) {
    answerers.push_back({TileWindow(store, pages), Partition<TexelAnswer>::Writer(partition)});
  }
  Requests groups(
      engine,
      [&](std::size_t worker, std::span<TexelRequest> tile) {
        answerers[worker].answer(tile, ranges);
      },
      [&](std::uint32_t, Spill<TexelRequest> tile) {
        SpillReader<TexelRequest> reader(tile, SpillReader<TexelRequest>::Mode::kConsume);
        for (auto some = reader.next_block(); !some.empty(); some = reader.next_block()) {
          answerers[0].answer(some, ranges);
        }
      });
  groups.process(std::move(requests), &stage);
  for (Answerer& answerer : answerers) answerer.answers.flush();
  return {ranges, partition.finish()};
}

}  // namespace atlasgauge
