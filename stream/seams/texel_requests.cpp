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

/// Whether there was anything to ask for.
template <class Push>
bool request_edge(const SeamEdges& edges, const TexelStore& store, std::uint32_t number,
                  const SeamCandidate& edge, Push push) {
  if (!edge.sampled || !is_decoded(store, edge)) return false;
  bool asked = false;
  for (std::size_t rule = 0; rule < edges.rules(); ++rule) {
    const SeamSamples samples = edges.samples(edge, rule);
    asked = asked || samples.count > 0;
    for (std::size_t side = 0; side < 2; ++side) {
      FootprintPart part{};
      part.seam = number;
      part.lane = SeamEdges::lane_of(rule, side) & 15U;
      request_path(store.image(edge.sides[side].slot), samples.sides[side], samples.count, part,
                   push);
    }
  }
  return asked;
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

Requests::Buckets request_texels(
    const Engine& engine, const SeamEdges& edges, const TexelStore& store, double requests,
    const std::function<void(std::size_t worker, const SeamCandidate& edge)>& on_unasked) {
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
  edges.visit(engine, stage,
              [&](std::size_t worker, std::uint32_t number, const SeamCandidate& edge) {
                const auto push = [&](const TexelRequest& request) {
                  writers[worker].push(ranges.bucket_of(request.tile), request);
                };
                if (!request_edge(edges, store, number, edge, push)) on_unasked(worker, edge);
              });
  for (auto& writer : writers) writer.flush();
  return {ranges, partition.finish()};
}

}  // namespace atlasgauge
