#include "stream/seams/seam_comparison.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "stream/engine/page_cache.hpp"
#include "stream/engine/partition.hpp"
#include "stream/engine/sort_spill.hpp"
#include "stream/seams/footprint_colours.hpp"

namespace atlasgauge {
namespace {

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

/// `answers(side)` are those of a side, in order.
template <class Answers>
double mean_distance(const SeamSamples& samples, const TexelKind (&kinds)[2], Answers answers) {
  if (samples.count == 0) return std::numeric_limits<double>::quiet_NaN();
  FootprintColours a(answers(0), samples.sides[0], kinds[0]);
  FootprintColours b(answers(1), samples.sides[1], kinds[1]);
  double sum = 0;
  for (std::uint64_t i = 0; i < samples.count; ++i) sum += distance(a.at(i), b.at(i));
  return sum / static_cast<double>(samples.count);
}

/// `answers(lane)` are those of a lane, in order.
template <class Answers>
SeamDistances distances_of(const SeamEdges& edges, const TexelStore& store,
                           const SeamCandidate& edge, Answers answers) {
  const TexelKind kinds[2] = {store.image(edge.sides[0].slot).kind,
                              store.image(edge.sides[1].slot).kind};
  SeamDistances distances;
  distances.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t rule = 0; rule < edges.rules(); ++rule) {
    distances[rule] = mean_distance(edges.samples(edge, rule), kinds, [&](std::size_t side) {
      return answers(SeamEdges::lane_of(rule, side));
    });
  }
  return distances;
}

SeamDistances compare_in_memory(const SeamEdges& edges, const TexelStore& store,
                                const SeamCandidate& edge, std::span<TexelAnswer> answers) {
  std::sort(answers.begin(), answers.end(), [](const TexelAnswer& a, const TexelAnswer& b) {
    return a.part.place() < b.part.place();
  });
  return distances_of(edges, store, edge, [&](std::uint8_t lane) {
    const auto first = std::partition_point(
        answers.begin(), answers.end(), [&](const TexelAnswer& a) { return a.part.lane < lane; });
    return AnswersInMemory({first, answers.end()});
  });
}

std::vector<Spill<TexelAnswer>> split_lanes(const Engine& engine, Spill<TexelAnswer> answers) {
  Partition<TexelAnswer> partition(engine.scratch, SeamEdges::kLanes);
  Partition<TexelAnswer>::Writer writer(partition);
  SpillReader<TexelAnswer> reader(answers, SpillReader<TexelAnswer>::Mode::kConsume);
  for (TexelAnswer answer{}; reader.read(answer);) writer.push(answer.part.lane, answer);
  writer.flush();
  return partition.finish();
}

/// An edge with more answers than memory.
SeamDistances compare_in_scratch(const Engine& engine, const SeamEdges& edges,
                                 const TexelStore& store, const SeamCandidate& edge,
                                 Spill<TexelAnswer> answers) {
  const Reservation memory = engine.budget.reserve(
      Partition<TexelAnswer>::memory_bytes(SeamEdges::kLanes, 1, engine.block_bytes()) +
          engine.block_bytes(),
      "a very long seam edge");
  std::vector<Spill<TexelAnswer>> lanes = split_lanes(engine, std::move(answers));
  for (Spill<TexelAnswer>& lane : lanes) {
    lane = sort_spill(engine, std::move(lane), [](const TexelAnswer& a, const TexelAnswer& b) {
      return a.part.index() < b.part.index();
    });
  }
  return distances_of(edges, store, edge,
                      [&](std::uint8_t lane) { return AnswersInScratch(lanes[lane]); });
}

}  // namespace

void compare_sides(const Engine& engine, const SeamEdges& edges, const TexelStore& store,
                   KeyedGroups<TexelAnswer>::Buckets answers,
                   const std::function<void(std::size_t worker, const SeamCandidate& edge,
                                            const SeamDistances& distances)>& on_edge) {
  StageLog::Stage stage(engine.log, "seam colours", answers.spills.size());
  const std::uint64_t page_bytes = PageLayout<SeamCandidate>::kBytes;
  const Reservation memory =
      engine.budget.reserve(engine.workers.count() * page_bytes, "comparing seams");
  // Of a bucket the edges come in order.
  std::vector<PageCache<SeamCandidate>> pages;
  for (std::size_t i = 0; i < engine.workers.count(); ++i) {
    pages.emplace_back(edges.spill(), page_bytes);
  }
  KeyedGroups<TexelAnswer> groups(
      engine,
      [&](std::size_t worker, std::span<TexelAnswer> group) {
        const SeamCandidate& edge = pages[worker].at(group[0].part.seam);
        on_edge(worker, edge, compare_in_memory(edges, store, edge, group));
      },
      [&](std::uint32_t number, Spill<TexelAnswer> group) {
        const SeamCandidate& edge = pages[0].at(number);
        on_edge(0, edge, compare_in_scratch(engine, edges, store, edge, std::move(group)));
      });
  groups.process(std::move(answers), &stage);
}

}  // namespace atlasgauge
