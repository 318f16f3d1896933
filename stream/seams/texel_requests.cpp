#include "stream/seams/texel_requests.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "io/bytes.hpp"
#include "io/error.hpp"
#include "stream/engine/partition.hpp"
#include "stream/seams/footprint_requests.hpp"

namespace atlasgauge {
namespace {

using Requests = KeyedGroups<TexelRequest>;

void add(TexelSurvey& survey, const SeamEdges& edges, const SeamCandidate& edge) {
  if (!edge.sampled) return;
  for (const SeamSide& side : edge.sides) survey.slots[raw(side.slot)] = true;
  if (edges.is_long(edge)) return;
  for (std::size_t rule = 0; rule < edges.rules(); ++rule) {
    for (const SeamPath& path : edges.samples(edge, rule).sides) {
      survey.requests += path.usual_footprints();
    }
  }
}

void merge(TexelSurvey& survey, const TexelSurvey& other) {
  survey.requests += other.requests;
  for (std::size_t i = 0; i < other.slots.size(); ++i) {
    if (other.slots[i]) survey.slots[i] = true;
  }
}

void require_room(const Scratch& scratch, double requests) {
  const double bytes = requests * sizeof(TexelAnswer);
  const std::uint64_t room_bytes = scratch.room_bytes();
  if (bytes <= static_cast<double>(room_bytes)) return;
  throw Error(ErrorKind::kResource,
              fmt::format("the seam edges are so long that their texels take about {:.0f} GiB of "
                          "scratch, but there is room for {}; free space there or give another "
                          "directory with --tmp-dir",
                          bytes / (1 << 30), format_bytes(room_bytes)));
}

bool has_samples(const SeamEdges& edges, const SeamCandidate& edge) {
  for (std::size_t rule = 0; rule < edges.rules(); ++rule) {
    if (edges.samples(edge, rule).count > 0) return true;
  }
  return false;
}

template <class Push>
void request_edge(const SeamEdges& edges, const TexelStore& store, std::uint32_t number,
                  const SeamCandidate& edge, Push push) {
  for (std::size_t rule = 0; rule < edges.rules(); ++rule) {
    const SeamSamples samples = edges.samples(edge, rule);
    for (std::size_t side = 0; side < 2; ++side) {
      FootprintPart part{};
      part.seam = number;
      part.lane = SeamEdges::lane_of(rule, side) & 15U;
      request_path(store.image(edge.sides[side].slot), samples.sides[side], samples.count, part,
                   push);
    }
  }
}

}  // namespace

TexelSurvey survey_texels(const Engine& engine, const SeamEdges& edges, std::size_t slots) {
  StageLog::Stage stage(engine.log, "seam lengths", edges.block_count());
  const TexelSurvey none{std::vector<bool>(slots), 0};
  std::vector<TexelSurvey> parts(engine.workers.count(), none);
  edges.visit(engine, stage, [&](std::size_t worker, std::uint32_t, const SeamCandidate& edge) {
    add(parts[worker], edges, edge);
  });
  TexelSurvey survey = none;
  for (const TexelSurvey& part : parts) merge(survey, part);
  return survey;
}

bool is_decoded(const TexelStore& store, const SeamCandidate& edge) {
  return store.image(edge.sides[0].slot).decoded && store.image(edge.sides[1].slot).decoded;
}

Requests::Buckets request_texels(const Engine& engine, const SeamEdges& edges,
                                 const TexelStore& store, double requests,
                                 const UnaskedEdges& unasked) {
  require_room(engine.scratch, requests);
  StageLog::Stage stage(engine.log, "seam requests", edges.block_count());
  const std::size_t workers = engine.workers.count();
  const std::uint64_t free_bytes = engine.budget.free_bytes();
  const KeyRanges ranges =
      Requests::plan(engine, static_cast<std::uint64_t>(requests), 0, store.tile_count(),
                     free_bytes / 8 * 7, free_bytes / 2, Requests::even_buckets(engine));
  const Reservation memory = engine.budget.reserve(
      Partition<TexelRequest>::memory_bytes(ranges.bucket_count(), workers, engine.block_bytes()),
      "distributing requests for texels");
  Partition<TexelRequest> partition(engine.scratch, ranges.bucket_count());
  std::vector<Partition<TexelRequest>::Writer> writers(workers,
                                                       Partition<TexelRequest>::Writer(partition));
  const auto ask = [&](std::size_t worker, std::uint32_t number, const SeamCandidate& edge) {
    const bool can = edge.sampled && is_decoded(store, edge) && has_samples(edges, edge);
    if (!can) return unasked.on_nothing(worker, edge);
    if (edges.is_long(edge)) return unasked.on_long(worker, number);
    request_edge(edges, store, number, edge, [&](const TexelRequest& request) {
      writers[worker].push(ranges.bucket_of(request.tile), request);
    });
  };
  edges.visit(engine, stage, ask);
  for (auto& writer : writers) writer.flush();
  return {ranges, partition.finish()};
}

}  // namespace atlasgauge
