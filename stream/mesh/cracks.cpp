#include "stream/mesh/cracks.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "stream/engine/gather.hpp"
#include "stream/engine/keyed_groups.hpp"

// Edges meet in the cells of grids, one for every power of two: an edge lies in the grid whose
// cells are longer than its box, up to twice, and than twice the largest step. So it, grown by a
// step, touches a few cells of its grid whatever its length, and a few long edges do not make the
// cells of all others wide. A point looks into its cell of every grid that has edges. Cells of all
// grids are hashed to 32 bits; that some share a hash makes more comparisons, not others.

namespace atlasgauge {
namespace {

struct Segment {
  Position p[2];
};

double coordinate(const Position& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

double largest_coordinate(const Segment& segment) {
  double most = 0;
  for (const Position& p : segment.p) {
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return most;
}

/// Half of the longest side of its box: a difference of halves cannot overflow.
double half_extent(const Segment& segment) {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = coordinate(segment.p[0], i), b = coordinate(segment.p[1], i);
    most = std::max(most, std::abs(b / 2 - a / 2));
  }
  return most;
}

/// An edge of a part in a cell, or a point of one that looks for others there.
struct CellRecord {
  std::uint32_t cell;
  std::uint32_t part;
  std::uint32_t edge;
  std::uint32_t point;  ///< of the edge: an end, or kMiddle; kSegment for all of it
  double length_3d;
  Segment segment;

  static constexpr std::uint32_t kMiddle = 2;

  static constexpr std::uint32_t kSegment = 3;

  std::uint32_t key() const { return cell; }
  bool is_segment() const { return point == kSegment; }
  Position point_position() const {
    if (point < kMiddle) return segment.p[point];
    const Position& a = segment.p[0];
    const Position& b = segment.p[1];
    return {a.x / 2 + b.x / 2, a.y / 2 + b.y / 2, a.z / 2 + b.z / 2};
  }
};
static_assert(sizeof(CellRecord) == 72);

bool by_part(const CellRecord& a, const CellRecord& b) {
  return a.part < b.part;
}

/// A point of an edge that lies at another part.
struct Touch {
  std::uint32_t edge;
  std::uint32_t point;
  double length_3d;

  std::uint32_t key() const { return edge; }
};
static_assert(sizeof(Touch) == 16);

/// The least over t in [0, 1] of the largest |a_i + t (b_i - a_i) - p_i|. As a function of t this
/// is convex and made of straight pieces, so it is least at an end or where two pieces meet.
double distance_by_axis(const Position& p, const Segment& segment) {
  std::array<double, 3> offset{}, slope{};
  for (std::size_t i = 0; i < 3; ++i) {
    offset[i] = coordinate(segment.p[0], i) - coordinate(p, i);
    slope[i] = coordinate(segment.p[1], i) - coordinate(segment.p[0], i);
  }
  double least = std::numeric_limits<double>::infinity();
  const auto try_at = [&](double t) {
    t = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0;
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(offset[i] + t * slope[i]));
    least = std::min(least, most);
  };
  try_at(0);
  try_at(1);
  for (std::size_t i = 0; i < 3; ++i) {
    try_at(-offset[i] / slope[i]);
    for (std::size_t j = 0; j < i; ++j) {
      try_at((offset[j] - offset[i]) / (slope[i] - slope[j]));
      try_at(-(offset[j] + offset[i]) / (slope[i] + slope[j]));
    }
  }
  return least;
}

/// Which part a face is of, and its step.
class PartOf {
 public:
  explicit PartOf(const std::vector<PartStart>& parts) : parts_(parts) {}

  std::uint32_t of(FaceId face) const {
    const auto after =
        std::ranges::upper_bound(parts_, std::uint64_t{raw(face)}, {}, &PartStart::first_face);
    return static_cast<std::uint32_t>(after - parts_.begin() - 1);
  }
  double step(std::uint32_t part) const { return parts_[part].position_step; }
  double largest_step() const {
    return std::ranges::max_element(parts_, {}, &PartStart::position_step)->position_step;
  }

 private:
  const std::vector<PartStart>& parts_;
};

/// The grids, by the power of two of their cells.
class Grids {
 public:
  static constexpr std::uint32_t kCells = std::uint32_t{1} << 30;  // hashes of them

  /// First, of every edge.
  void expect(const Segment& segment) { has_edges_[index(level(segment))] = true; }
  /// Then: the largest distance at which edges meet. Edges of finer grids move to the finest with
  /// cells of that size.
  void set_reach(double reach) {
    reach_ = reach;
    least_level_ = level_of(reach);
    const auto finest = has_edges_.begin() + static_cast<std::ptrdiff_t>(index(least_level_));
    const auto any = std::find(has_edges_.begin(), finest, true);
    if (any == finest) return;
    std::fill(any, finest, false);
    *finest = true;
  }

  /// Calls use(cell) for each cell that the segment, grown by the reach, may touch: three in each
  /// direction at most.
  template <class Use>
  void cells_of(const Segment& segment, Use use) const {
    const int at = level(segment);
    std::array<double, 3> low{}, high{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [least, most] =
          std::minmax({coordinate(segment.p[0], i), coordinate(segment.p[1], i)});
      low[i] = cell(least - reach_, at);
      high[i] = cell(most + reach_, at);
    }
    for (double x = low[0]; x <= high[0]; x = next(x)) {
      for (double y = low[1]; y <= high[1]; y = next(y)) {
        for (double z = low[2]; z <= high[2]; z = next(z)) use(hash(at, x, y, z));
      }
    }
  }

  /// Calls use(cell) for the cell of the point in each grid that has edges.
  template <class Use>
  void cells_of(const Position& p, Use use) const {
    for (std::size_t i = 0; i < has_edges_.size(); ++i) {
      if (!has_edges_[i]) continue;
      const int at = static_cast<int>(i) - kOffset;
      use(hash(at, cell(p.x, at), cell(p.y, at), cell(p.z, at)));
    }
  }

 private:
  static constexpr int kOffset = 1100;  // more than the exponent of any double

  /// Of cells longer than twice `half`.
  static int level_of(double half) { return half > 0 ? std::ilogb(half) + 2 : 2 - kOffset; }
  int level(const Segment& segment) const {
    return std::max(least_level_, level_of(half_extent(segment)));
  }
  static std::size_t index(int level) {
    const int place = level + kOffset;
    return static_cast<std::size_t>(place);
  }
  static double cell(double x, int level) { return std::floor(std::scalbn(x, -level)) + 0.0; }
  /// Beyond 2^53 cells the next one is the next double.
  static double next(double cell) {
    return std::max(cell + 1, std::nextafter(cell, std::numeric_limits<double>::infinity()));
  }
  static std::uint32_t hash(int level, double x, double y, double z) {
    std::uint64_t h = index(level);
    for (const double c : {x, y, z}) {
      h = (h ^ std::bit_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15;
      h ^= h >> 32;
    }
    return static_cast<std::uint32_t>(h % kCells);
  }

  double reach_ = 0;
  int least_level_ = level_of(0);
  std::vector<bool> has_edges_ = std::vector<bool>(std::size_t{2} * kOffset);
};

/// Open edges with their positions.
class PlacedEdges {
 public:
  PlacedEdges(const Engine& engine, Spill<OpenEdge> edges, Spill<Position>& vertices,
              const PartOf& part_of)
      : edges_(std::move(edges)), part_of_(part_of) {
    SpillWriter<std::uint32_t> ends(engine.scratch);
    SpillReader<OpenEdge> reader(edges_);
    for (OpenEdge edge{}; reader.read(edge);) {
      ends.push(raw(edge.v[0]));
      ends.push(raw(edge.v[1]));
    }
    ends_ = gather(engine, ends.finish(), vertices, Position{});
  }

  std::uint64_t size() const { return edges_.size(); }

  /// Calls use(record) for every edge, whole; the cell is left out.
  template <class Use>
  void visit(Use use) {
    SpillReader<OpenEdge> edges(edges_);
    SpillReader<Position> ends(ends_);
    OpenEdge edge{};
    for (std::uint32_t i = 0; edges.read(edge); ++i) {
      CellRecord record{};
      record.part = part_of_.of(edge.face);
      record.edge = i;
      record.point = CellRecord::kSegment;
      ends.read(record.segment.p);
      record.length_3d = distance(record.segment.p[0], record.segment.p[1]);
      use(record);
    }
  }

 private:
  Spill<OpenEdge> edges_;
  Spill<Position> ends_;
  const PartOf& part_of_;
};

/// How far apart the rounding to floats may put what was at one place, at most.
double float_error(double coordinate) {
  return std::ldexp(coordinate, -23);
}

class CrackSearch {
 public:
  CrackSearch(const Engine& engine, Spill<OpenEdge> edges, Spill<Position>& vertices,
              const std::vector<PartStart>& parts, GroupSinks& sinks)
      : engine_(engine),
        sinks_(sinks),
        part_of_(parts),
        edges_(engine, std::move(edges), vertices, part_of_),
        touches_(engine.scratch) {}

  void run() {
    const Grids grids = make_grids();
    compare(distribute(grids));
    count();
  }

 private:
  using CellGroups = KeyedGroups<CellRecord>;
  using TouchWriter = SharedSpill<Touch>::Writer;
  static constexpr unsigned kAllPoints = 7;

  Grids make_grids() {
    Grids grids;
    double largest = 0;
    edges_.visit([&](const CellRecord& edge) {
      largest = std::max(largest, largest_coordinate(edge.segment));
      grids.expect(edge.segment);
    });
    grids.set_reach(part_of_.largest_step() + float_error(largest));
    return grids;
  }

  CellGroups::Buckets distribute(const Grids& grids) {
    constexpr std::uint64_t kUsualCells = 11;  // eight of the edge, one of each of its points
    return CellGroups::distribute(engine_, kUsualCells * edges_.size(), Grids::kCells,
                                  "boundary edges in cells", [&](auto push) {
                                    edges_.visit([&](CellRecord edge) {
                                      const auto push_to = [&](std::uint32_t cell) {
                                        edge.cell = cell;
                                        push(0, edge);
                                      };
                                      grids.cells_of(edge.segment, push_to);
                                      for (edge.point = 0; !edge.is_segment(); ++edge.point) {
                                        grids.cells_of(edge.point_position(), push_to);
                                      }
                                    });
                                  });
  }

  void compare(CellGroups::Buckets buckets) {
    const Reservation memory = engine_.budget.reserve(
        (engine_.workers.count() + 1) * Partition<Touch>::staging_bytes(engine_.block_bytes()) +
            engine_.block_bytes(),
        "boundary edges that meet");
    std::vector<TouchWriter> writers;
    for (std::size_t i = 0; i < engine_.workers.count(); ++i) writers.emplace_back(touches_);
    CellGroups groups(
        engine_,
        [&](std::size_t worker, std::span<CellRecord> cell) { compare(cell, writers[worker]); },
        [&](std::uint32_t, Spill<CellRecord> cell) { compare(std::move(cell), writers[0]); });
    groups.process(std::move(buckets));
    for (TouchWriter& writer : writers) writer.flush();
  }

  /// The edges of a cell by part, so that a point passes over those of its own.
  static std::span<CellRecord> edges_by_part(std::span<CellRecord> cell) {
    const auto points = std::partition(cell.begin(), cell.end(),
                                       [](const CellRecord& r) { return r.is_segment(); });
    const auto edges = cell.first(static_cast<std::size_t>(points - cell.begin()));
    std::sort(edges.begin(), edges.end(), by_part);
    return edges;
  }

  void compare(std::span<CellRecord> cell, TouchWriter& touches) const {
    const std::span<CellRecord> edges = edges_by_part(cell);
    for (const CellRecord& point : cell.subspan(edges.size())) compare(point, edges, touches);
  }

  /// A cell with more than memory: its edges as many at a time as fit, each time with all points.
  void compare(Spill<CellRecord> cell, TouchWriter& touches) const {
    const Reservation memory = engine_.budget.reserve_between(
        2 * engine_.block_bytes() + 64 * sizeof(CellRecord), cell.size() * sizeof(CellRecord),
        "boundary edges at one place");
    const std::size_t most =
        (memory.bytes() - std::min(memory.bytes(), 2 * engine_.block_bytes())) / sizeof(CellRecord);
    SpillReader<CellRecord> edges(cell);
    std::vector<CellRecord> held;
    const auto compare_held = [&] {
      std::sort(held.begin(), held.end(), by_part);
      SpillReader<CellRecord> points(cell);
      for (CellRecord point{}; points.read(point);) {
        if (!point.is_segment()) compare(point, held, touches);
      }
      held.clear();
    };
    held.reserve(most);
    for (CellRecord edge{}; edges.read(edge);) {
      if (edge.is_segment()) held.push_back(edge);
      if (held.size() == most) compare_held();
    }
    compare_held();
  }

  void compare(const CellRecord& point, std::span<const CellRecord> edges,
               TouchWriter& touches) const {
    const auto [own, others] = std::equal_range(edges.begin(), edges.end(), point, by_part);
    const auto touches_it = [&](const CellRecord& edge) { return touch(point, edge); };
    if (std::any_of(edges.begin(), own, touches_it) ||
        std::any_of(others, edges.end(), touches_it)) {
      touches.push({point.edge, point.point, point.length_3d});
    }
  }

  bool touch(const CellRecord& point, const CellRecord& edge) const {
    const double step = std::max(part_of_.step(point.part), part_of_.step(edge.part));
    if (step == 0) return false;
    const double most = step + float_error(std::max(largest_coordinate(point.segment),
                                                    largest_coordinate(edge.segment)));
    return distance_by_axis(point.point_position(), edge.segment) <= most;
  }

  /// An edge may have been found at the same point several times.
  void count() {
    using EdgeGroups = KeyedGroups<Touch>;
    Spill<Touch> touches = touches_.finish();
    EdgeGroups::Buckets buckets =
        EdgeGroups::distribute(engine_, touches.size(), edges_.size(), "cracks", [&](auto push) {
          SpillReader<Touch> reader(touches, SpillReader<Touch>::Mode::kConsume);
          for (Touch touch{}; reader.read(touch);) push(0, touch);
        });
    std::vector<GroupBuffer<CrackEdge>> cracks;
    for (std::size_t i = 0; i < engine_.workers.count(); ++i) {
      cracks.emplace_back(sinks_.of_worker(i));
    }
    EdgeGroups groups(
        engine_,
        [&](std::size_t worker, std::span<Touch> edge) {
          if (is_whole(edge)) cracks[worker].push({edge[0].length_3d});
        },
        [&](std::uint32_t, Spill<Touch> edge) {
          unsigned points = 0;
          Touch touch{};
          for (SpillReader<Touch> reader(edge); reader.read(touch);) points |= 1U << touch.point;
          if (points == kAllPoints) cracks[0].push({touch.length_3d});
        });
    groups.process(std::move(buckets));
    for (auto& buffer : cracks) buffer.flush();
  }

  static bool is_whole(std::span<const Touch> edge) {
    unsigned points = 0;
    for (const Touch& touch : edge) points |= 1U << touch.point;
    return points == kAllPoints;
  }

  const Engine& engine_;
  GroupSinks& sinks_;
  PartOf part_of_;
  PlacedEdges edges_;
  SharedSpill<Touch> touches_;
};

}  // namespace

void find_cracks(const Engine& engine, Spill<OpenEdge> edges, Spill<Position>& vertices,
                 const std::vector<PartStart>& parts, GroupSinks& sinks) {
  if (edges.empty()) return;
  StageLog::Stage stage(engine.log, "cracks", edges.size());
  CrackSearch(engine, std::move(edges), vertices, parts, sinks).run();
}

}  // namespace atlasgauge
