#include "stream/mesh/charts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stream/engine/gather.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/engine/row_visit.hpp"
#include "stream/engine/sort_spill.hpp"

namespace atlasgauge {
namespace {

__extension__ typedef __int128 Int128;

/// A face in its chart, or one of the chart's border edges.
struct ChartPart {
  std::uint32_t chart;
  std::uint32_t face_and_flags;
  std::uint32_t slot_and_flags;
  UvBox box;
  double area_uv;            ///< signed
  double area_3d_or_length;  ///< length in texels of a border

  static constexpr std::uint32_t kFlipped = 1U << 30;
  static constexpr std::uint32_t kConflict = 1U << 31;
  static constexpr std::uint32_t kBorder = 1U << 31;

  std::uint32_t key() const { return chart; }
  FaceId face() const { return FaceId{face_and_flags & ~(kFlipped | kConflict)}; }
  bool flipped() const { return (face_and_flags & kFlipped) != 0; }
  bool conflict() const { return (face_and_flags & kConflict) != 0; }
  bool is_border() const { return (slot_and_flags & kBorder) != 0; }
};
static_assert(sizeof(ChartPart) == 48);

/// Numbers in units of 2^-61 of the largest, so that sums do not depend on the order. That largest
/// is the chart's own: a single face elsewhere may be 10^76 times larger.
class FixedUnit {
 public:
  void take(double value) { largest_ = std::max(largest_, std::abs(value)); }
  void fix() { scale_ = 61 - std::ilogb(std::max(largest_, 1e-300)); }
  Int128 of(double value) const {
    return static_cast<Int128>(std::llrint(std::scalbn(value, scale_)));
  }
  double value(Int128 sum) const { return std::scalbn(static_cast<double>(sum), -scale_); }

 private:
  double largest_ = 0;
  int scale_ = 0;
};

/// What the sums of one chart are counted in.
struct ChartUnits {
  FixedUnit area_uv, area_3d, length;

  void take(const ChartPart& part) {
    if (part.is_border()) return length.take(part.area_3d_or_length);
    area_uv.take(part.area_uv);
    area_3d.take(part.area_3d_or_length);
  }
  void fix() {
    area_uv.fix();
    area_3d.fix();
    length.fix();
  }
};

/// Adds up one chart, in fixed point; signs are taken before rounding.
class ChartSum {
 public:
  ChartSum(std::uint32_t chart, ChartUnits units) : chart_(chart), units_(units) { units_.fix(); }

  void add(const ChartPart& part) {
    if (part.is_border()) {
      perimeter_ += units_.length.of(part.area_3d_or_length);
      return;
    }
    ++faces_;
    slot_ = part.slot_and_flags;
    conflict_ = conflict_ || part.conflict();
    box_.merge(part.box);
    area_3d_ += units_.area_3d.of(part.area_3d_or_length);
    if (part.area_uv == 0) return;
    const Int128 area = units_.area_uv.of(part.area_uv);
    absolute_ += area < 0 ? -area : area;
    as_is_.add(area, part.area_uv > 0);
    coherent_.add(part.flipped() ? -area : area, (part.area_uv > 0) != part.flipped());
  }

  Chart finish(const SlotFrames& frames) const {
    Chart chart{};
    chart.first_face = FaceId{chart_};
    chart.faces = faces_;
    chart.null = as_is_.positive + as_is_.negative == 0;
    chart.orientable = !conflict_;
    chart.folds = (conflict_ ? as_is_ : coherent_).folds(absolute_);
    chart.slot = slot_ == kNoSlot ? kNone<SlotId> : SlotId{slot_};
    chart.area_3d = units_.area_3d.value(area_3d_);
    chart.area_uv = units_.area_uv.value(absolute_);
    chart.perimeter = units_.length.value(perimeter_);
    chart.uv_box = box_;
    const SlotFrame& frame = frames.of(chart.slot);
    chart.width = frame.width * (double{box_.high_u} - double{box_.low_u});
    chart.height = frame.height * (double{box_.high_v} - double{box_.low_v});
    return chart;
  }

  static constexpr std::uint32_t kNoSlot = ChartPart::kBorder - 1;

 private:
  struct Signs {
    Int128 total = 0;
    std::uint64_t positive = 0, negative = 0;

    void add(Int128 area, bool is_positive) {
      total += area;
      ++(is_positive ? positive : negative);
    }
    /// Faces against the sign of the total; of a chart closed in UV (|total| <= 1e-9 of the sum of
    /// absolute areas), the fewer.
    std::uint64_t folds(Int128 absolute) const {
      const Int128 size = total < 0 ? -total : total;
      if (static_cast<double>(size) <= 1e-9 * static_cast<double>(absolute)) {
        return std::min(positive, negative);
      }
      return total > 0 ? negative : positive;
    }
  };

  std::uint32_t chart_;
  ChartUnits units_;
  std::uint64_t faces_ = 0;
  std::uint32_t slot_ = kNoSlot;
  bool conflict_ = false;
  UvBox box_;
  Int128 area_3d_ = 0, perimeter_ = 0, absolute_ = 0;
  Signs as_is_, coherent_;
};

ChartPart part_of(const Label& chart, std::uint32_t flags, const FaceFacts& facts,
                  const AtlasFace& face, std::uint32_t number) {
  ChartPart part{};
  part.chart = chart.first();
  part.face_and_flags = number | flags;
  part.slot_and_flags = face.slot() == kNone<SlotId> ? ChartSum::kNoSlot : raw(face.slot());
  part.area_uv = facts.area_uv();
  part.area_3d_or_length = face.area_3d();
  for (int k = 0; k < 3 && face.has_uv_triangle(); ++k) part.box.add(face.uv(k));
  return part;
}

template <class Push>
void push_faces(const Engine& engine, ChartParts& parts, Push push) {
  const auto push_rows = [&](std::size_t worker, std::uint64_t first_face, auto charts,
                             auto classes, auto facts, auto faces) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (!facts[i].at_welded_level()) continue;
      const std::uint32_t flags = (classes[i].parity() ? ChartPart::kFlipped : 0) |
                                  (classes[i].conflict() ? ChartPart::kConflict : 0);
      const auto number = static_cast<std::uint32_t>(first_face + i);
      push(worker, part_of(charts[i], flags, facts[i], faces[i], number));
    }
  };
  visit_rows(engine, push_rows, parts.labels.by_all_edges(), parts.labels.by_manifold_edges(),
             parts.facts, parts.faces);
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
    push(0, {chart.first(), 0, ChartPart::kBorder, {}, 0, border.length_texels});
  }
}

KeyedGroups<ChartPart>::Buckets distribute_parts(const Engine& engine, ChartParts& parts) {
  Spill<Label> charts_of_borders;
  if (!parts.borders.empty()) {
    charts_of_borders = charts_of(engine, parts.borders, parts.labels.by_all_edges());
  }
  return KeyedGroups<ChartPart>::distribute(engine, parts.facts.size() + parts.borders.size(),
                                            parts.facts.size(), "distributing faces to charts",
                                            [&](auto push) {
                                              push_faces(engine, parts, push);
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
  void push_null_face(FaceId face) { null_faces_.push(face); }

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
  KeyedGroups<ChartPart>::Buckets buckets = distribute_parts(engine, parts);
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
        ChartUnits units;
        for (const ChartPart& part : group) units.take(part);
        ChartSum sum(group[0].chart, units);
        for (const ChartPart& part : group) sum.add(part);
        const Chart chart = sum.finish(frames);
        outputs[worker].push(chart);
        if (!chart.null) return;
        for (const ChartPart& part : group) {
          if (!part.is_border()) outputs[worker].push_null_face(part.face());
        }
      },
      [&](std::uint32_t number, Spill<ChartPart> group) {
        ChartUnits units;
        ChartPart part{};
        for (SpillReader<ChartPart> reader(group); reader.read(part);) units.take(part);
        ChartSum sum(number, units);
        for (SpillReader<ChartPart> reader(group); reader.read(part);) sum.add(part);
        const Chart chart = sum.finish(frames);
        outputs[0].push(chart);
        if (!chart.null) return;
        for (SpillReader<ChartPart> reader(group); reader.read(part);) {
          if (!part.is_border()) outputs[0].push_null_face(part.face());
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
