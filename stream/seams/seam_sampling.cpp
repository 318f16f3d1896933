#include "stream/seams/seam_sampling.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "stream/engine/partition.hpp"
#include "stream/seams/long_seams.hpp"
#include "stream/seams/seam_comparison.hpp"
#include "stream/seams/seam_edges.hpp"
#include "stream/seams/seam_output.hpp"
#include "stream/seams/texel_answers.hpp"
#include "stream/seams/texel_requests.hpp"
#include "stream/seams/texture_sums.hpp"

namespace atlasgauge {
namespace {

/// Staging of the writers and groups of a worker.
constexpr std::uint64_t kOutputBytes = 32 << 10;

std::uint64_t own_bytes(const Engine& engine, std::size_t slots) {
  return engine.workers.count() * (engine.block_bytes() + kOutputBytes) + 5 * engine.block_bytes() +
         slots * (sizeof(StoredImage) + engine.workers.count());
}

SeamEdge measured(const SeamCandidate& candidate, std::uint64_t samples,
                  const SeamDistances& distances) {
  SeamEdge edge = unmeasured(candidate, true);
  edge.samples = samples;
  edge.discrepancy = distances[0];
  edge.texmetro_discrepancy = distances[1];
  return edge;
}

SeamWork work_of(const TexelStore& store, std::size_t slots) {
  SeamWork work;
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    const StoredImage& image = store.image(SlotId{slot});
    if (!image.decoded) continue;
    ++work.images_decoded;
    work.texels_decoded += std::uint64_t{image.size.width} * image.size.height;
  }
  return work;
}

void warn_of_nonfinite(std::uint64_t edges, const std::string& model, Warnings& warnings) {
  if (edges == 0) return;
  warnings.add("colours not finite", model, 0,
               fmt::format("{} seam edges lie on texels that are not numbers, and are not "
                           "measured; mend the images",
                           edges));
}

}  // namespace

void require_room_for_seams(const Engine& engine, const TextureSlots& textures,
                            const DecodePlan& plan) {
  const Reservation memory =
      engine.budget.reserve(own_bytes(engine, textures.slots.size()), "sampling seams");
  require_room_for_images(engine, textures, plan);
}

SeamResults sample_seams(const Engine& engine, Spill<SeamCandidate> candidates,
                         const TextureSlots& textures, const SlotFrames& frames,
                         const SeamPlan& plan, Warnings& warnings, GroupSinks& sinks) {
  const std::size_t slots = textures.slots.size();
  const Reservation memory = engine.budget.reserve(own_bytes(engine, slots), "sampling seams");
  SharedSpill<TextureSample> by_texture(engine.scratch);
  SharedSpill<SeamEdge> kept(engine.scratch);
  std::vector<SeamOutput> outputs;
  for (std::size_t i = 0; i < engine.workers.count(); ++i) {
    outputs.emplace_back(sinks.of_worker(i), by_texture, kept, plan.keep_edges);
  }

  SharedSpill<std::uint32_t> long_edges(engine.scratch);
  std::vector<SharedSpill<std::uint32_t>::Writer> long_writers(
      engine.workers.count(), SharedSpill<std::uint32_t>::Writer(long_edges));

  const SeamEdges edges(std::move(candidates), frames, plan.texmetro);
  const TexelSurvey survey = survey_texels(engine, edges, slots);
  const TexelStore store = decode_images(engine, textures, survey.slots, plan.decode, warnings);

  const auto on_nothing = [&](std::size_t worker, const SeamCandidate& edge) {
    outputs[worker].push(unmeasured(edge, edge.sampled && is_decoded(store, edge)));
  };
  const auto on_long = [&](std::size_t worker, std::uint32_t number) {
    long_writers[worker].push(number);
  };
  const auto on_compared = [&](std::size_t worker, const SeamCandidate& edge,
                               const SeamDistances& distances) {
    const std::uint64_t samples = edges.samples(edge, 0).count;
    samples == 0 || std::isfinite(distances[0])
        ? outputs[worker].push(measured(edge, samples, distances))
        : outputs[worker].push_nonfinite(unmeasured(edge, false));
  };
  auto requests = request_texels(engine, edges, store, survey.requests, {on_nothing, on_long});
  auto answers = answer_requests(engine, store, std::move(requests), edges.size());
  compare_sides(engine, edges, store, std::move(answers), on_compared, long_writers[0]);
  for (auto& writer : long_writers) writer.flush();
  compare_along(engine, edges, store, long_edges.finish(), on_compared);

  SeamResults results;
  results.work = work_of(store, slots);
  std::uint64_t nonfinite = 0;
  for (SeamOutput& output : outputs) {
    output.flush();
    results.work.sample_pairs += output.sample_pairs();
    nonfinite += output.nonfinite();
  }
  warn_of_nonfinite(nonfinite, plan.decode.model, warnings);
  results.edges = kept.finish();
  results.textures = sum_by_texture(engine, by_texture.finish(), slots);
  return results;
}

}  // namespace atlasgauge
