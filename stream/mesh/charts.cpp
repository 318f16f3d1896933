#include "stream/mesh/charts.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "stream/engine/gather.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/engine/row_visit.hpp"
#include "stream/engine/sort_spill.hpp"
#include "stream/mesh/chart_runs.hpp"
#include "stream/mesh/chart_sum.hpp"

namespace atlasgauge {
namespace {

/// The part that a face is.
ChartPart part_of(const Label& chart, const Label& of_class, const AtlasFace& face, double area_uv,
                  double area_3d, std::uint32_t number) {
  ChartPart part{};
  part.chart = chart.first();
  part.first_face_and_flags = number | (of_class.parity() ? ChartPart::kFlipped : 0) |
                              (of_class.conflict() ? ChartPart::kConflict : 0);
  part.slot_and_flags = (face.slot() == kNone<SlotId> ? ChartPart::kNoSlot : raw(face.slot())) |
                        (face.has_uv_triangle() ? ChartPart::kUvTriangles : 0) |
                        (area_uv < 0 ? ChartPart::kNegative : 0) |
                        (area_uv == 0 ? ChartPart::kNoArea : 0);
  part.faces = 1;
  part.area_uv = area_uv;
  part.area_3d_or_length = area_3d;
  if (!face.has_uv_triangle()) return part;
  std::tie(part.low_u, part.high_u) = std::minmax({face.uv(0).u, face.uv(1).u, face.uv(2).u});
  std::tie(part.low_v, part.high_v) = std::minmax({face.uv(0).v, face.uv(1).v, face.uv(2).v});
  return part;
}

/// `areas_3d` may be missing, and count as 0 then.
template <class Push, class... Areas>
void push_faces(const Engine& engine, ChartParts& parts, const SlotFrames& frames, Push push,
                const Areas&... areas_3d) {
  std::vector<ChartRuns> runs(engine.workers.count());
  const auto push_rows = [&](std::size_t worker, std::uint64_t first_face, auto charts,
                             auto classes, auto faces, auto... areas) {
    const auto push_part = [&](const ChartPart& part) { push(worker, part); };
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const AtlasFace& face = faces[i];
      if (!face.at_welded_level()) continue;
      const auto number = static_cast<std::uint32_t>(first_face + i);
      const double area_uv = face.area_uv(frames.of(face.slot()));
      const double area_3d = (0.0 + ... + areas[i]);
      runs[worker].add(part_of(charts[i], classes[i], face, area_uv, area_3d, number), push_part);
    }
  };
  visit_rows(engine, push_rows, parts.labels.by_all_edges(), parts.labels.by_manifold_edges(),
             parts.faces, areas_3d...);
  for (ChartRuns& of_worker : runs) {
    of_worker.end_all([&](const ChartPart& part) { push(0, part); });
  }
}

/// The charts of the borders, in their order.
Spill<Label> charts_of(const Engine& engine, Spill<BorderEdge>& borders, Spill<Label>& charts) {
  SpillWriter<std::uint32_t> faces(engine.scratch);
  SpillReader<BorderEdge> reader(borders);
  BorderEdge border{};
  while (reader.read(border)) faces.push(raw(border.face));
  return gather(engine, faces.finish(), charts, Label());
}

template <class Push>
void push_borders(Spill<BorderEdge>& borders, Spill<Label>& charts_of_borders, Push push) {
  SpillReader<BorderEdge> edges(borders, SpillReader<BorderEdge>::Mode::kConsume);
  SpillReader<Label> charts(charts_of_borders, SpillReader<Label>::Mode::kConsume);
  BorderEdge border{};
  Label chart;
  while (edges.read(border) && charts.read(chart)) {
    push(0, ChartPart::of_border(chart.first(), border.length_texels));
  }
}

KeyedGroups<ChartPart>::Buckets distribute_parts(const Engine& engine, ChartParts& parts,
                                                 const SlotFrames& frames) {
  Spill<Label> charts_of_borders;
  if (!parts.borders.empty()) {
    charts_of_borders = charts_of(engine, parts.borders, parts.labels.by_all_edges());
  }
  return KeyedGroups<ChartPart>::distribute(
      engine, parts.faces.size() + parts.borders.size(), parts.faces.size(),
      "distributing faces to charts", [&](auto push) {
        parts.areas_3d.empty() ? push_faces(engine, parts, frames, push)
                               : push_faces(engine, parts, frames, push, parts.areas_3d);
        push_borders(parts.borders, charts_of_borders, push);
      });
}

/// Where one worker puts its charts.
class ChartOutput {
 public:
  ChartOutput(GroupSink& sink, SharedSpill<FaceId>& null_faces, SharedSpill<Chart>* kept,
              std::vector<std::unique_ptr<SampleStore>>& samples)
      : sink_(&sink), charts_(sink), null_faces_(null_faces) {
    if (kept != nullptr) kept_.emplace_back(*kept);
    for (auto& store : samples) samples_.emplace_back(*store);
  }

  void push(const Chart& chart) {
    charts_.push(chart);
    for (auto& kept : kept_) kept.push(chart);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      taken_.clear();
      sink_->sample(i, std::span(&chart, 1), taken_);
      for (const Sample& sample : taken_) samples_[i].push(sample);
    }
  }
  void push_null_faces(const ChartPart& part) {
    for (std::uint32_t i = 0; i < part.faces; ++i) null_faces_.push(FaceId{part.first_face() + i});
  }

  void flush() {
    charts_.flush();
    null_faces_.flush();
    for (auto& kept : kept_) kept.flush();
    for (auto& writer : samples_) writer.flush();
  }

 private:
  GroupSink* sink_;
  GroupBuffer<Chart> charts_;
  SharedSpill<FaceId>::Writer null_faces_;
  std::vector<SharedSpill<Chart>::Writer> kept_;  // one, or none
  std::vector<SampleStore::Writer> samples_;
  std::vector<Sample> taken_;
};

}  // namespace

ChartResults group_charts(const Engine& engine, ChartParts parts, const SlotFrames& frames,
                          bool keep, GroupSinks& sinks,
                          std::vector<std::unique_ptr<SampleStore>>& samples) {
  const std::size_t workers = engine.workers.count();
  KeyedGroups<ChartPart>::Buckets buckets = distribute_parts(engine, parts, frames);
  const Reservation memory = engine.budget.reserve(
      (samples.size() + 2) * Partition<Sample>::memory_bytes(1, workers, engine.block_bytes()),
      "charts and samples of them");
  SharedSpill<FaceId> null_faces(engine.scratch);
  SharedSpill<Chart> kept(engine.scratch);
  std::vector<ChartOutput> outputs;
  for (std::size_t i = 0; i < workers; ++i) {
    outputs.emplace_back(sinks.of_worker(i), null_faces, keep ? &kept : nullptr, samples);
  }
  KeyedGroups<ChartPart> groups(
      engine,
      [&](std::size_t worker, std::span<ChartPart> group) {
        ChartSum sum;
        for (const ChartPart& part : group) sum.add(part);
        const Chart chart = sum.finish(FaceId{group[0].chart}, frames);
        outputs[worker].push(chart);
        if (!chart.null) return;
        for (const ChartPart& part : group) outputs[worker].push_null_faces(part);
      },
      [&](std::uint32_t number, Spill<ChartPart> group) {
        ChartSum sum;
        ChartPart part{};
        for (SpillReader<ChartPart> reader(group); reader.read(part);) sum.add(part);
        const Chart chart = sum.finish(FaceId{number}, frames);
        outputs[0].push(chart);
        if (!chart.null) return;
        for (SpillReader<ChartPart> reader(group); reader.read(part);) {
          outputs[0].push_null_faces(part);
        }
      });
  groups.process(std::move(buckets));
  for (ChartOutput& output : outputs) output.flush();
  const auto by_number = [](const Chart& a, const Chart& b) {
    return raw(a.first_face) < raw(b.first_face);
  };
  return {null_faces.finish(), sort_spill(engine, kept.finish(), by_number)};
}

}  // namespace atlasgauge
