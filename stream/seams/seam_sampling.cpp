#include "stream/seams/seam_sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "io/bytes.hpp"
#include "io/error.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/engine/page_cache.hpp"
#include "stream/engine/sort_spill.hpp"
#include "stream/seams/footprint_requests.hpp"
#include "stream/seams/seam_distance.hpp"
#include "stream/seams/seam_output.hpp"
#include "stream/seams/seam_rule.hpp"
#include "stream/seams/texel_answers.hpp"
#include "stream/seams/texel_lookup.hpp"
#include "stream/seams/texture_sums.hpp"

namespace atlasgauge {
namespace {

/// A rule and a side make a lane.
constexpr std::size_t kRules = 2;
constexpr std::size_t kLanes = 2 * kRules;

std::uint8_t lane_of(std::size_t rule, int side) {
  return static_cast<std::uint8_t>(2 * rule + static_cast<std::size_t>(side));
}

std::span<const SeamRule> rules_of(const SeamPlan& plan) {
  static constexpr std::array<SeamRule, kRules> kAll{kSeamRule, kTexMetroRule};
  return std::span(kAll).first(plan.texmetro ? kRules : 1);
}

/// The answers of one lane, in memory.
class AnswersInMemory {
 public:
  explicit AnswersInMemory(std::span<const TexelAnswer> answers) : next_(answers.data()) {}
  const TexelAnswer& next() { return *next_++; }

 private:
  const TexelAnswer* next_;
};

/// The same in scratch.
class AnswersInScratch {
 public:
  explicit AnswersInScratch(Spill<TexelAnswer>& answers)
      : reader_(answers, SpillReader<TexelAnswer>::Mode::kConsume) {}
  const TexelAnswer& next() {
    reader_.read(answer_);
    return answer_;
  }

 private:
  SpillReader<TexelAnswer> reader_;
  TexelAnswer answer_{};
};

class SeamSampling {
 public:
  SeamSampling(const Engine& engine, Spill<SeamCandidate> edges, const TextureSlots& textures,
               const SlotFrames& frames, const SeamPlan& plan, GroupSinks& sinks)
      : engine_(engine),
        edges_(std::move(edges)),
        textures_(textures),
        frames_(frames),
        plan_(plan),
        rules_(rules_of(plan)),
        memory_(engine.budget.reserve(own_bytes(), "sampling seams")),
        samples_(engine.scratch),
        kept_(engine.scratch) {
    for (std::size_t i = 0; i < engine.workers.count(); ++i) {
      outputs_.emplace_back(sinks.of_worker(i), samples_, kept_, plan.keep_edges);
    }
  }

  SeamResults run(Warnings& warnings) {
    const Survey survey = look_over_edges();
    const TexelStore store =
        decode_images(engine_, textures_, survey.wanted, plan_.decode, warnings);
    KeyedGroups<TexelRequest>::Buckets requests = request_texels(store, survey.requests);
    KeyedGroups<TexelAnswer>::Buckets answers =
        answer_requests(engine_, store, std::move(requests), edges_.size());
    compare(store, std::move(answers));
    return finish(store, warnings);
  }

 private:
  /// What the edges will need.
  struct Survey {
    std::vector<bool> wanted;  ///< slots
    double requests = 0;
  };

  std::uint64_t own_bytes() const {
    const std::uint64_t worker =
        engine_.block_bytes() + kOutputBytes + PageLayout<SeamCandidate>::kBytes;
    return engine_.workers.count() * worker + 4 * engine_.block_bytes() +
           textures_.slots.size() * (sizeof(StoredImage) + 2 * engine_.workers.count());
  }

  /// Calls use(worker, number, edge) for all edges, on all workers.
  template <class Use>
  void visit_edges(StageLog::Stage* stage, Use use) {
    std::vector<BlockBuffer> buffers(engine_.workers.count());
    engine_.workers.for_each(edges_.block_count(), [&](std::size_t worker, std::size_t block) {
      auto number = static_cast<std::uint32_t>(block * edges_.records_per_block());
      for (const SeamCandidate& edge : edges_.load(block, buffers[worker])) {
        use(worker, number++, edge);
      }
      if (stage != nullptr && worker == 0) stage->progress(block + 1);
    });
  }

  Survey look_over_edges() {
    struct Part {
      std::vector<bool> wanted;
      double requests = 0;
    };
    std::vector<Part> parts(engine_.workers.count(), {std::vector<bool>(textures_.slots.size())});
    visit_edges(nullptr, [&](std::size_t worker, std::uint32_t, const SeamCandidate& edge) {
      if (!edge.sampled) return;
      Part& part = parts[worker];
      for (const SeamSide& side : edge.sides) part.wanted[raw(side.slot)] = true;
      for (const SeamRule& rule : rules_) {
        const SeamSamples samples = samples_of(edge, frames_, rule);
        for (const SeamPath& path : samples.sides) part.requests += path.usual_footprints();
      }
    });
    Survey survey{std::vector<bool>(textures_.slots.size()), 0};
    for (const Part& part : parts) {
      survey.requests += part.requests;
      for (std::size_t i = 0; i < part.wanted.size(); ++i) {
        if (part.wanted[i]) survey.wanted[i] = true;
      }
    }
    return survey;
  }

  bool is_decoded(const TexelStore& store, const SeamCandidate& edge) const {
    return store.image(edge.sides[0].slot).decoded && store.image(edge.sides[1].slot).decoded;
  }

  /// Edges that have nothing to ask for are handed out.
  KeyedGroups<TexelRequest>::Buckets request_texels(const TexelStore& store, double requests) {
    using Groups = KeyedGroups<TexelRequest>;
    require_room(requests);
    StageLog::Stage stage(engine_.log, "seam texels", edges_.block_count());
    const std::uint64_t free_bytes = engine_.budget.free_bytes();
    const KeyRanges ranges =
        Groups::plan(engine_, static_cast<std::uint64_t>(requests), 0, store.tile_count(),
                     free_bytes / 8 * 7, free_bytes / 2, Groups::even_buckets(engine_));
    const Reservation memory = engine_.budget.reserve(
        Partition<TexelRequest>::memory_bytes(ranges.bucket_count(), engine_.workers.count(),
                                              engine_.block_bytes()),
        "distributing requests for texels");
    Partition<TexelRequest> partition(engine_.scratch, ranges.bucket_count());
    std::vector<Partition<TexelRequest>::Writer> writers(
        engine_.workers.count(), Partition<TexelRequest>::Writer(partition));
    visit_edges(&stage, [&](std::size_t worker, std::uint32_t number, const SeamCandidate& edge) {
      const auto push = [&](const TexelRequest& request) {
        writers[worker].push(ranges.bucket_of(request.tile), request);
      };
      if (!request_edge(store, number, edge, push)) hand_out_unsampled(worker, store, edge);
    });
    for (auto& writer : writers) writer.flush();
    return {ranges, partition.finish()};
  }

  void require_room(double requests) const {
    const double bytes = requests * sizeof(TexelAnswer);
    const std::uint64_t room_bytes = engine_.scratch.room_bytes();
    if (bytes <= static_cast<double>(room_bytes)) return;
    throw Error(ErrorKind::kResource,
                fmt::format("the seam edges are so long that their texels take about {:.0f} GiB of "
                            "scratch, but there is room for {}; free space there or give another "
                            "directory with --tmp-dir",
                            bytes / (1 << 30), format_bytes(room_bytes)));
  }

  /// Whether there was anything to ask for.
  template <class Push>
  bool request_edge(const TexelStore& store, std::uint32_t number, const SeamCandidate& edge,
                    Push push) const {
    if (!edge.sampled || !is_decoded(store, edge)) return false;
    bool asked = false;
    for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
      const SeamSamples samples = samples_of(edge, frames_, rules_[rule]);
      for (int side = 0; side < 2; ++side) {
        FootprintPart part{};
        part.seam = number;
        part.lane = lane_of(rule, side) & 15U;
        request_path(store.image(edge.sides[side].slot), samples.sides[side], samples.count, part,
                     push);
      }
      asked = asked || samples.count > 0;
    }
    return asked;
  }

  void hand_out_unsampled(std::size_t worker, const TexelStore& store,
                          const SeamCandidate& candidate) {
    SeamEdge edge = edge_of(candidate);
    edge.sampled = edge.sampled && is_decoded(store, candidate);
    outputs_[worker].push(edge);
  }

  void compare(const TexelStore& store, KeyedGroups<TexelAnswer>::Buckets answers) {
    StageLog::Stage stage(engine_.log, "seam colours", answers.spills.size());
    std::vector<PageCache<SeamCandidate>> edges;
    for (std::size_t i = 0; i < engine_.workers.count(); ++i) {
      edges.emplace_back(edges_, PageLayout<SeamCandidate>::kBytes);
    }
    KeyedGroups<TexelAnswer> groups(
        engine_,
        [&](std::size_t worker, std::span<TexelAnswer> group) {
          compare_in_memory(worker, store, edges[worker].at(group[0].part.seam), group);
        },
        [&](std::uint32_t edge, Spill<TexelAnswer> group) {
          compare_in_scratch(store, edges[0].at(edge), std::move(group));
        });
    groups.process(std::move(answers), &stage);
  }

  void compare_in_memory(std::size_t worker, const TexelStore& store, const SeamCandidate& edge,
                         std::span<TexelAnswer> answers) {
    std::sort(answers.begin(), answers.end(), [](const TexelAnswer& a, const TexelAnswer& b) {
      return a.part.place() < b.part.place();
    });
    hand_out(worker, store, edge, [&](std::uint8_t lane) {
      const auto first = std::partition_point(
          answers.begin(), answers.end(), [&](const TexelAnswer& a) { return a.part.lane < lane; });
      return AnswersInMemory(answers.subspan(static_cast<std::size_t>(first - answers.begin())));
    });
  }

  /// An edge with more answers than memory.
  void compare_in_scratch(const TexelStore& store, const SeamCandidate& edge,
                          Spill<TexelAnswer> answers) {
    Partition<TexelAnswer> partition(engine_.scratch, kLanes);
    Partition<TexelAnswer>::Writer writer(partition);
    {
      SpillReader<TexelAnswer> reader(answers, SpillReader<TexelAnswer>::Mode::kConsume);
      TexelAnswer answer{};
      while (reader.read(answer)) writer.push(answer.part.lane, answer);
    }
    writer.flush();
    std::vector<Spill<TexelAnswer>> lanes = partition.finish();
    for (Spill<TexelAnswer>& lane : lanes) {
      lane = sort_spill(engine_, std::move(lane), [](const TexelAnswer& a, const TexelAnswer& b) {
        return a.part.index() < b.part.index();
      });
    }
    hand_out(0, store, edge, [&](std::uint8_t lane) { return AnswersInScratch(lanes[lane]); });
  }

  /// `answers(lane)` has the answers of a lane in order.
  template <class Answers>
  void hand_out(std::size_t worker, const TexelStore& store, const SeamCandidate& candidate,
                Answers answers) {
    const TexelKind kinds[2] = {store.image(candidate.sides[0].slot).kind,
                                store.image(candidate.sides[1].slot).kind};
    const auto mean = [&](std::size_t rule, const SeamSamples& samples) {
      return mean_distance(samples, kinds, [&](int side) { return answers(lane_of(rule, side)); });
    };
    SeamEdge edge = edge_of(candidate);
    const SeamSamples samples = samples_of(candidate, frames_, rules_[0]);
    edge.samples = samples.count;
    edge.discrepancy = mean(0, samples);
    if (plan_.texmetro) {
      edge.texmetro_discrepancy = mean(1, samples_of(candidate, frames_, rules_[1]));
    }
    if (edge.samples > 0 && !std::isfinite(edge.discrepancy)) {
      outputs_[worker].count_nonfinite();
      edge = edge_of(candidate);
      edge.sampled = false;
    }
    outputs_[worker].push(edge);
  }

  SeamResults finish(const TexelStore& store, Warnings& warnings) {
    SeamResults results;
    std::uint64_t nonfinite = 0;
    for (SeamOutput& output : outputs_) {
      output.flush();
      results.work.sample_pairs += output.sample_pairs();
      nonfinite += output.nonfinite();
    }
    if (nonfinite > 0) {
      warnings.add("colours not finite", plan_.decode.model, 0,
                   fmt::format("{} seam edges lie on texels that are not numbers, and are not "
                               "measured; mend the images",
                               nonfinite));
    }
    for (std::uint32_t slot = 0; slot < textures_.slots.size(); ++slot) {
      const StoredImage& image = store.image(SlotId{slot});
      if (!image.decoded) continue;
      ++results.work.images_decoded;
      results.work.texels_decoded += std::uint64_t{image.size.width} * image.size.height;
    }
    results.edges = kept_.finish();
    results.textures = sum_by_texture(engine_, samples_.finish(), textures_.slots.size());
    return results;
  }

  /// Staging of the writers and groups of a worker.
  static constexpr std::uint64_t kOutputBytes = 32 << 10;

  const Engine& engine_;
  Spill<SeamCandidate> edges_;
  const TextureSlots& textures_;
  const SlotFrames& frames_;
  const SeamPlan& plan_;
  std::span<const SeamRule> rules_;
  Reservation memory_;
  SharedSpill<TextureSample> samples_;
  SharedSpill<SeamEdge> kept_;
  std::vector<SeamOutput> outputs_;
};

}  // namespace

SeamResults sample_seams(const Engine& engine, Spill<SeamCandidate> edges,
                         const TextureSlots& textures, const SlotFrames& frames,
                         const SeamPlan& plan, Warnings& warnings, GroupSinks& sinks) {
  return SeamSampling(engine, std::move(edges), textures, frames, plan, sinks).run(warnings);
}

}  // namespace atlasgauge
