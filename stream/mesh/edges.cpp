#include "stream/mesh/edges.hpp"

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "stream/engine/early_groups.hpp"
#include "stream/engine/sort_spill.hpp"

namespace atlasgauge {
namespace {

/// An edge with more faces than this is streamed through sorts of its own.
constexpr std::size_t kLargeEdgeFaces = 4096;

template <class Record>
constexpr bool kWelded = std::is_same_v<Record, WeldedHalfEdge>;

const auto by_hi = [](const HalfEdge& a, const HalfEdge& b) { return a.hi < b.hi; };

const auto by_raw = [](const auto& a, const auto& b) {
  return std::pair(a.raw_at_lo(), a.raw_at_hi()) < std::pair(b.raw_at_lo(), b.raw_at_hi());
};

bool same_raw_edge(const auto& a, const auto& b) {
  return a.raw_at_lo() == b.raw_at_lo() && a.raw_at_hi() == b.raw_at_hi();
}

const auto by_uv = [](const HalfEdge& a, const HalfEdge& b) {
  return std::tuple(a.slot_bits(), bits_of(a.uv_lo), bits_of(a.uv_hi)) <
         std::tuple(b.slot_bits(), bits_of(b.uv_lo), bits_of(b.uv_hi));
};

bool same_uv_edge(const HalfEdge& a, const HalfEdge& b) {
  return a.slot_bits() == b.slot_bits() && bits_of(a.uv_lo) == bits_of(b.uv_lo) &&
         bits_of(a.uv_hi) == bits_of(b.uv_hi);
}

/// Where all workers put what their edges say.
struct OutputSpills {
  explicit OutputSpills(Scratch& scratch)
      : raw_links(scratch),
        uv_links(scratch),
        boundary_links(scratch),
        seams(scratch),
        borders(scratch),
        open(scratch) {}

  SharedSpill<Link> raw_links, uv_links, boundary_links;
  SharedSpill<SeamCandidate> seams;
  SharedSpill<BorderEdge> borders;
  SharedSpill<OpenEdge> open;
};

/// The part of one worker.
struct Output {
  static std::uint64_t memory_bytes(std::size_t block_bytes) {
    return 3 * Partition<Link>::staging_bytes(block_bytes) +
           Partition<SeamCandidate>::staging_bytes(block_bytes) +
           Partition<BorderEdge>::staging_bytes(block_bytes) +
           Partition<OpenEdge>::staging_bytes(block_bytes) + GroupBuffer<RawEdge>::memory_bytes() +
           GroupBuffer<UvEdge>::memory_bytes();
  }

  Output(GroupSink& sink, OutputSpills& spills, const EdgeTable::Plan& plan)
      : raw_edges(sink),
        uv_edges(sink),
        raw_links(spills.raw_links),
        uv_links(spills.uv_links),
        boundary_links(spills.boundary_links),
        seams(spills.seams),
        keep_borders(plan.keep_borders),
        borders(spills.borders),
        keep_open(plan.keep_open),
        open(spills.open) {}

  void flush() {
    raw_edges.flush();
    uv_edges.flush();
    raw_links.flush();
    uv_links.flush();
    boundary_links.flush();
    seams.flush();
    borders.flush();
    open.flush();
  }

  GroupBuffer<RawEdge> raw_edges;
  GroupBuffer<UvEdge> uv_edges;
  SharedSpill<Link>::Writer raw_links, uv_links, boundary_links;
  SharedSpill<SeamCandidate>::Writer seams;
  bool keep_borders;
  SharedSpill<BorderEdge>::Writer borders;
  bool keep_open;
  SharedSpill<OpenEdge>::Writer open;
  bool raw_manifold = true;
  bool uv_manifold = true;
};

/// The faces on one edge, as they come: links each with the one before. Whether the first link is
/// manifold shows only when a third face does not follow.
template <class Record>
class FaceChain {
 public:
  void add(const Record& half_edge, SharedSpill<Link>::Writer& links) {
    if (++faces_ == 1) {
      first_ = half_edge;
    } else if (faces_ == 2) {
      second_ = half_edge;
    } else {
      if (faces_ == 3) links.push({raw(first_.face), raw(second_.face), false, false});
      links.push({raw(last_), raw(half_edge.face), false, false});
    }
    last_ = half_edge.face;
  }

  /// Ends the edge.
  void close(SharedSpill<Link>::Writer& links) {
    if (faces_ == 2) links.push({raw(first_.face), raw(second_.face), true, !coherent()});
  }

  void clear() { faces_ = 0; }
  std::uint64_t faces() const { return faces_; }
  const Record& first() const { return first_; }
  bool coherent() const { return faces_ == 2 && first_.forward() != second_.forward(); }

 private:
  std::uint64_t faces_ = 0;
  Record first_{}, second_{};
  FaceId last_{};
};

/// Takes the half-edges of one welded edge in raw order and makes its raw edges.
template <class Record>
class RawEdges {
 public:
  explicit RawEdges(Output& output) : output_(output) {}

  void add(const Record& half_edge) {
    if (chain_.faces() > 0 && !same_raw_edge(chain_.first(), half_edge)) close();
    chain_.add(half_edge, output_.raw_links);
  }

  void close() {
    if (chain_.faces() == 0) return;
    chain_.close(output_.raw_links);
    const Record& first = chain_.first();
    output_.raw_edges.push({chain_.faces(), first.length_3d, chain_.coherent()});
    if (chain_.faces() == 1) output_.boundary_links.push({first.raw_at_lo(), first.raw_at_hi()});
    if (chain_.faces() > 2) output_.raw_manifold = false;
    chain_.clear();
  }

 private:
  Output& output_;
  FaceChain<Record> chain_;
};

/// Takes the half-edges of one welded edge in uv order and makes its uv edges.
template <class Record>
class UvEdges {
 public:
  UvEdges(Output& output, const SlotFrames& frames) : output_(output), frames_(frames) {}

  void add(const Record& half_edge) {
    if (chain_.faces() > 0 && !same_uv_edge(chain_.first(), half_edge)) close();
    chain_.add(half_edge, output_.uv_links);
  }

  void close() {
    if (chain_.faces() == 0) return;
    chain_.close(output_.uv_links);
    const double edge_length = length(chain_.first());
    output_.uv_edges.push({chain_.faces(), edge_length});
    if (chain_.faces() == 1 && output_.keep_borders) {
      output_.borders.push({chain_.first().face, 0, edge_length});
    }
    if (chain_.faces() > 2) output_.uv_manifold = false;
    chain_.clear();
  }

 private:
  double length(const Record& half_edge) const {
    if (!half_edge.has_uv_triangle()) return 0;
    const SlotFrame& frame = frames_.of(half_edge.slot());
    return distance(frame.texel(half_edge.uv_lo), frame.texel(half_edge.uv_hi));
  }

  Output& output_;
  const SlotFrames& frames_;
  FaceChain<Record> chain_;
};

SeamCandidate seam_between(const HalfEdge& one, const HalfEdge& other) {
  const bool in_order = by_uv(one, other);
  const HalfEdge& a = in_order ? one : other;
  const HalfEdge& b = in_order ? other : one;
  SeamCandidate seam{};
  seam.v[0] = VertexId{a.lo};
  seam.v[1] = VertexId{a.hi};
  seam.faces[0] = a.face;
  seam.faces[1] = b.face;
  seam.sides[0] = {a.slot(), {a.uv_lo, a.uv_hi}};
  seam.sides[1] = {b.slot(), {b.uv_lo, b.uv_hi}};
  seam.length_3d = a.length_3d;
  seam.sampled = a.has_uv_triangle() && b.has_uv_triangle() && a.sampled() && b.sampled();
  seam.runs_down[0] = !a.forward();
  seam.runs_down[1] = !b.forward();
  return seam;
}

template <class Record>
class EdgeTableOf : public EdgeTable {
 public:
  EdgeTableOf(const Engine& engine, const Plan& plan, const LastUses& last_faces,
              const SlotFrames& frames, GroupSinks& sinks)
      : engine_(engine),
        frames_(frames),
        outputs_memory_(engine.budget.reserve(
            6 * engine.block_bytes() +
                engine.workers.count() * Output::memory_bytes(engine.block_bytes()),
            "links of edges")),
        spills_(engine.scratch),
        half_edges_(engine.workers.count()),
        groups_(
            engine,
            {3 * plan.faces, static_cast<std::uint32_t>(plan.vertices),
             plan.memory_bytes - std::min(plan.memory_bytes, outputs_memory_.bytes()),
             "grouping half-edges"},
            last_faces,
            [this](std::size_t worker, std::span<Record> star) {
              split_star(star, outputs_[worker]);
            },
            [this](std::uint32_t, Spill<Record> star) {
              split_hot_star(std::move(star), outputs_[0]);
            }) {
    for (std::size_t i = 0; i < engine.workers.count(); ++i) {
      outputs_.emplace_back(sinks.of_worker(i), spills_, plan);
    }
  }

  void add(std::size_t worker, std::span<const Triangle> triangles) override {
    std::vector<Record>& half_edges = half_edges_[worker];
    half_edges.clear();
    for (const Triangle& triangle : triangles) {
      if (!triangle.at_raw_level()) continue;
      const std::uint32_t bits = bits_of_face(triangle);
      for (int k = 0; k < 3; ++k) {
        half_edges.push_back(half_edge(triangle, k, (k + 1) % 3, bits));
      }
    }
    groups_.add(worker, half_edges);
    groups_.group_passed(worker);
  }

  void pass(std::uint64_t faces) override { groups_.pass(faces); }
  void settle() override { groups_.settle(); }

  EdgeResults finish() override {
    StageLog::Stage stage(engine_.log, "edges", 1);
    groups_.process();
    EdgeResults results;
    for (Output& output : outputs_) {
      output.flush();
      results.raw_manifold = results.raw_manifold && output.raw_manifold;
      results.uv_manifold = results.uv_manifold && output.uv_manifold;
    }
    results.raw_links = spills_.raw_links.finish();
    results.uv_links = spills_.uv_links.finish();
    results.boundary_links = spills_.boundary_links.finish();
    results.seams = spills_.seams.finish();
    results.borders = spills_.borders.finish();
    results.open = spills_.open.finish();
    return results;
  }

 private:
  std::uint32_t bits_of_face(const Triangle& triangle) const {
    const std::uint32_t slot =
        triangle.slot == kNone<SlotId> ? HalfEdge::kSlotMask : raw(triangle.slot);
    const bool sampled =
        triangle.has_uv_triangle && !triangle.uv_far && frames_.of(triangle.slot).readable;
    return slot | (triangle.at_welded_level() ? 0 : HalfEdge::kRawOnly) |
           (triangle.has_uv_triangle ? HalfEdge::kUvTriangle : 0) |
           (sampled ? 0 : HalfEdge::kUnsampled);
  }

  /// The half-edge from corner i to corner j.
  static Record half_edge(const Triangle& triangle, int i, int j, std::uint32_t bits) {
    const auto ends = [&](int k) { return std::pair(triangle.w[k], triangle.v[k]); };
    const bool forward = ends(i) < ends(j);
    const int lo = forward ? i : j;
    const int hi = forward ? j : i;
    Record record{};
    record.lo = raw(triangle.w[lo]);
    record.hi = raw(triangle.w[hi]);
    record.face = triangle.face;
    record.bits = bits | (forward ? HalfEdge::kForward : 0);
    record.uv_lo = triangle.t[lo];
    record.uv_hi = triangle.t[hi];
    record.length_3d = distance(triangle.p[lo], triangle.p[hi]);
    if constexpr (kWelded<Record>) {
      record.raw_lo = raw(triangle.v[lo]);
      record.raw_hi = raw(triangle.v[hi]);
    }
    return record;
  }

  /// The half-edges with one lower vertex.
  void split_star(std::span<Record> star, Output& output) const {
    std::sort(star.begin(), star.end(), by_hi);
    for (std::size_t begin = 0, end = 0; begin < star.size(); begin = end) {
      while (end < star.size() && star[end].hi == star[begin].hi) ++end;
      welded_edge(star.subspan(begin, end - begin), output);
    }
  }

  void welded_edge(std::span<Record> edge, Output& output) const {
    if (kWelded<Record>) std::sort(edge.begin(), edge.end(), by_raw);
    RawEdges<Record> raw_edges(output);
    for (const Record& half_edge : edge) raw_edges.add(half_edge);
    raw_edges.close();

    if (kWelded<Record>) {
      const auto whole =
          std::partition(edge.begin(), edge.end(), [](const Record& h) { return !h.raw_only(); });
      edge = edge.first(static_cast<std::size_t>(whole - edge.begin()));
    }
    if (edge.size() == 2 && !same_uv_edge(edge[0], edge[1])) {
      output.seams.push(seam_between(edge[0], edge[1]));
    }
    if (edge.size() == 1 && output.keep_open) {
      const Record& only = edge[0];
      output.open.push({{VertexId{only.raw_at_lo()}, VertexId{only.raw_at_hi()}}, only.face});
    }
    if (edge.size() > 2) std::sort(edge.begin(), edge.end(), by_uv);
    UvEdges<Record> uv_edges(output, frames_);
    for (const Record& half_edge : edge) uv_edges.add(half_edge);
    uv_edges.close();
  }

  /// A lower vertex with more half-edges than memory.
  void split_hot_star(Spill<Record> star, Output& output) {
    Spill<Record> sorted = sort_spill(engine_, std::move(star), by_hi);
    SpillReader<Record> reader(sorted, SpillReader<Record>::Mode::kConsume);
    std::vector<Record> edge;
    Record next{};
    bool more = reader.read(next);
    while (more) {
      edge.clear();
      while (more && edge.size() < kLargeEdgeFaces && (edge.empty() || next.hi == edge[0].hi)) {
        edge.push_back(next);
        more = reader.read(next);
      }
      if (!more || next.hi != edge[0].hi) {
        welded_edge(edge, output);
        continue;
      }
      SpillWriter<Record> rest(engine_.scratch);
      rest.append(edge);
      while (more && next.hi == edge[0].hi) {
        rest.push(next);
        more = reader.read(next);
      }
      large_edge(rest.finish(), output);
    }
  }

  /// An edge with more than kLargeEdgeFaces faces: no seam, but raw and uv edges as any other.
  void large_edge(Spill<Record> edge, Output& output) {
    SpillWriter<Record> whole_faces(engine_.scratch);
    RawEdges<Record> raw_edges(output);
    stream_sorted(std::move(edge), by_raw, [&](const Record& half_edge) {
      raw_edges.add(half_edge);
      if (!half_edge.raw_only()) whole_faces.push(half_edge);
    });
    raw_edges.close();
    UvEdges<Record> uv_edges(output, frames_);
    stream_sorted(whole_faces.finish(), by_uv,
                  [&](const Record& half_edge) { uv_edges.add(half_edge); });
    uv_edges.close();
  }

  template <class Less, class Use>
  void stream_sorted(Spill<Record> records, Less less, Use use) {
    Spill<Record> sorted = sort_spill(engine_, std::move(records), less);
    SpillReader<Record> reader(sorted, SpillReader<Record>::Mode::kConsume);
    for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
      for (const Record& record : block) use(record);
    }
  }

  const Engine& engine_;
  const SlotFrames& frames_;
  Reservation outputs_memory_;
  OutputSpills spills_;
  std::vector<Output> outputs_;
  std::vector<std::vector<Record>> half_edges_;  // of the triangles in hand, by worker
  EarlyGroups<Record> groups_;
};

}  // namespace

std::unique_ptr<EdgeTable> EdgeTable::make(const Engine& engine, const Plan& plan,
                                           const LastUses& last_faces, const SlotFrames& frames,
                                           GroupSinks& sinks) {
  if (plan.welded) {
    return std::make_unique<EdgeTableOf<WeldedHalfEdge>>(engine, plan, last_faces, frames, sinks);
  }
  return std::make_unique<EdgeTableOf<HalfEdge>>(engine, plan, last_faces, frames, sinks);
}

}  // namespace atlasgauge
