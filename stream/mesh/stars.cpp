#include "stream/mesh/stars.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "stream/engine/early_groups.hpp"
#include "stream/engine/labels.hpp"
#include "stream/engine/sort_spill.hpp"

namespace atlasgauge {
namespace {

/// A vertex with more corners than this is streamed through sorts of its own: counting it in memory
/// takes 28 bytes a corner besides the corners.
constexpr std::size_t kLargestStar = 1 << 15;

/// A corner of a face at vertex v, and the two other vertices of the face.
struct StarCorner {
  std::uint32_t v, a, b;
  std::uint32_t key() const { return v; }
};

/// The two other vertices of a face that has v as its smallest, in order.
std::pair<std::uint32_t, std::uint32_t> pair_of(const StarCorner& corner) {
  return std::minmax(corner.a, corner.b);
}
bool owns_face(const StarCorner& corner) {
  return corner.v < corner.a && corner.v < corner.b;
}

/// Counts the edges at a vertex from its neighbours, one entry a face and neighbour, in order.
class NeighbourCount {
 public:
  /// Whether the neighbour is the same as the one before.
  bool add(std::uint32_t neighbour) {
    const bool same = uses_ > 0 && neighbour == last_;
    if (!same) close();
    last_ = neighbour;
    ++uses_;
    return same;
  }
  void close() {
    if (uses_ == 0) return;
    ++edges_;
    if (uses_ == 1) ++boundary_edges_;
    if (uses_ > 2) nonmanifold_edge_ = true;
    uses_ = 0;
  }
  std::uint64_t edges() const { return edges_; }
  std::uint64_t boundary_edges() const { return boundary_edges_; }
  bool nonmanifold_edge() const { return nonmanifold_edge_; }

 private:
  std::uint32_t last_ = 0;
  std::uint64_t uses_ = 0;
  std::uint64_t edges_ = 0;
  std::uint64_t boundary_edges_ = 0;
  bool nonmanifold_edge_ = false;
};

/// Works on stars that fit in memory; keeps its buffers from one to the next.
class StarCounter {
 public:
  VertexStar count(std::span<const StarCorner> corners) {
    sort_neighbours(corners);
    unite_neighbours(corners.size());
    return {corners.size(), neighbours_.boundary_edges(), neighbours_.nonmanifold_edge(),
            fans_ == 1, duplicate_faces(corners)};
  }

 private:
  void sort_neighbours(std::span<const StarCorner> corners) {
    uses_.clear();
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      uses_.push_back(std::uint64_t{corners[i].a} << 32 | i);
      uses_.push_back(std::uint64_t{corners[i].b} << 32 | i);
    }
    std::sort(uses_.begin(), uses_.end());
  }

  /// Corners that share a neighbour are in one fan: union-find over the corners.
  void unite_neighbours(std::size_t corners) {
    parent_.resize(corners);
    std::iota(parent_.begin(), parent_.end(), 0U);
    fans_ = corners;
    neighbours_ = {};
    for (std::size_t i = 0; i < uses_.size(); ++i) {
      const auto neighbour = static_cast<std::uint32_t>(uses_[i] >> 32);
      if (neighbours_.add(neighbour)) {
        unite(static_cast<std::uint32_t>(uses_[i - 1]), static_cast<std::uint32_t>(uses_[i]));
      }
    }
    neighbours_.close();
  }

  std::uint32_t find(std::uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    --fans_;
  }

  std::uint64_t duplicate_faces(std::span<const StarCorner> corners) {
    pairs_.clear();
    for (const StarCorner& corner : corners) {
      if (owns_face(corner)) pairs_.push_back(pair_of(corner));
    }
    if (pairs_.size() < 2) return 0;
    std::sort(pairs_.begin(), pairs_.end());
    const auto distinct = std::unique(pairs_.begin(), pairs_.end());
    return static_cast<std::uint64_t>(pairs_.end() - distinct);
  }

  std::vector<std::uint64_t> uses_;  ///< neighbour and corner, in one number that sorts fast
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
  std::vector<std::uint32_t> parent_;
  std::size_t fans_ = 0;
  NeighbourCount neighbours_;
};

/// A star with more corners than memory: its neighbours, numbered in order, are the nodes and its
/// corners the links of a graph whose components are the fans.
class HotStar {
 public:
  explicit HotStar(const Engine& engine) : engine_(engine) {}

  VertexStar count(Spill<StarCorner> corners) {
    const std::uint64_t corner_count = corners.size();
    SpillWriter<std::uint32_t> neighbours(engine_.scratch);
    SpillWriter<Pair> pairs(engine_.scratch);
    SpillWriter<Pair> links(engine_.scratch);
    SpillReader<StarCorner> reader(corners, SpillReader<StarCorner>::Mode::kConsume);
    for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
      for (const StarCorner& corner : block) {
        neighbours.push(corner.a);
        neighbours.push(corner.b);
        links.push({corner.a, corner.b});
        if (!owns_face(corner)) continue;
        const auto [low, high] = pair_of(corner);
        pairs.push({low, high});
      }
    }
    const NeighbourCount edges = count_neighbours(neighbours.finish());
    Spill<Pair> half = number_low_ends(links.finish());
    Spill<Pair> numbered = number_low_ends(std::move(half));
    return {corner_count, edges.boundary_edges(), edges.nonmanifold_edge(),
            count_fans(std::move(numbered), edges.edges()) == 1, count_duplicates(pairs.finish())};
  }

 private:
  struct Pair {
    std::uint32_t low, high;
    auto operator<=>(const Pair&) const = default;
  };

  NeighbourCount count_neighbours(Spill<std::uint32_t> neighbours) {
    Spill<std::uint32_t> sorted = sort_spill(engine_, std::move(neighbours), std::less<>());
    NeighbourCount count;
    SpillWriter<std::uint32_t> distinct(engine_.scratch);
    SpillReader<std::uint32_t> reader(sorted, SpillReader<std::uint32_t>::Mode::kConsume);
    std::uint32_t neighbour = 0;
    while (reader.read(neighbour)) {
      if (!count.add(neighbour)) distinct.push(neighbour);
    }
    count.close();
    distinct_ = distinct.finish();
    return count;
  }

  /// Puts the number of a neighbour in its place, at one end of every pair, and swaps the ends.
  Spill<Pair> number_low_ends(Spill<Pair> pairs) {
    Spill<Pair> sorted = sort_spill(engine_, std::move(pairs), std::less<>());
    SpillReader<Pair> reader(sorted, SpillReader<Pair>::Mode::kConsume);
    SpillReader<std::uint32_t> distinct(distinct_);
    SpillWriter<Pair> numbered(engine_.scratch);
    std::uint32_t neighbour = 0;
    std::uint32_t numbers = 0;
    Pair pair{};
    while (reader.read(pair)) {
      while (numbers == 0 || neighbour != pair.low) {
        distinct.read(neighbour);
        ++numbers;
      }
      numbered.push({pair.high, numbers - 1});
    }
    return numbered.finish();
  }

  std::uint64_t count_fans(Spill<Pair> pairs, std::uint64_t neighbours) {
    SpillWriter<Link> links(engine_.scratch);
    SpillReader<Pair> reader(pairs, SpillReader<Pair>::Mode::kConsume);
    Pair pair{};
    while (reader.read(pair)) links.push({pair.low, pair.high});
    Spill<Label> labels = label_nodes(engine_, links.finish(), neighbours, LinkRule::kAll);
    return count_components(labels);
  }

  std::uint64_t count_duplicates(Spill<Pair> pairs) {
    Spill<Pair> sorted = sort_spill(engine_, std::move(pairs), std::less<>());
    SpillReader<Pair> reader(sorted);
    std::uint64_t duplicates = 0;
    std::optional<Pair> last;
    Pair pair{};
    while (reader.read(pair)) {
      if (last == pair) ++duplicates;
      last = pair;
    }
    return duplicates;
  }

  const Engine& engine_;
  Spill<std::uint32_t> distinct_;  // neighbours, in order
};

/// Hands out the stars of one worker, and counts the vertices on boundary edges as they pass.
class StarOutput {
 public:
  explicit StarOutput(GroupSink& sink) : stars_(sink) {}
  void push(const VertexStar& star) {
    if (star.boundary_edges > 0) ++boundary_vertices_;
    stars_.push(star);
  }
  std::uint64_t finish() {
    stars_.flush();
    return boundary_vertices_;
  }

 private:
  GroupBuffer<VertexStar> stars_;
  std::uint64_t boundary_vertices_ = 0;
};

}  // namespace

class StarTable::Impl {
 public:
  Impl(const Engine& engine, const Plan& plan, const LastUses& last_faces, GroupSinks& sinks)
      : engine_(engine),
        counters_(engine.workers.count()),
        hot_(engine),
        corners_(engine.workers.count()),
        groups_(
            engine,
            {3 * plan.faces, static_cast<std::uint32_t>(plan.vertices), plan.memory_bytes,
             "grouping corners"},
            last_faces,
            [this](std::size_t worker, std::span<StarCorner> star) {
              outputs_[worker].push(counters_[worker].count(star));
            },
            [this](std::uint32_t, Spill<StarCorner> star) {
              outputs_[0].push(hot_.count(std::move(star)));
            },
            kLargestStar) {
    for (std::size_t i = 0; i < engine.workers.count(); ++i) {
      outputs_.emplace_back(sinks.of_worker(i));
    }
  }

  void add(std::size_t worker, std::span<const Triangle> triangles) {
    std::vector<StarCorner>& corners = corners_[worker];
    corners.clear();
    for (const Triangle& triangle : triangles) {
      if (!triangle.at_raw_level()) continue;
      const std::uint32_t v[3] = {raw(triangle.v[0]), raw(triangle.v[1]), raw(triangle.v[2])};
      for (int k = 0; k < 3; ++k) corners.push_back({v[k], v[(k + 1) % 3], v[(k + 2) % 3]});
    }
    groups_.add(worker, corners);
    groups_.group_passed(worker);
  }

  void pass(std::uint64_t faces) { groups_.pass(faces); }
  void settle() { groups_.settle(); }

  std::uint64_t finish() {
    StageLog::Stage stage(engine_.log, "vertex stars", 1);
    groups_.process();
    std::uint64_t boundary_vertices = 0;
    for (StarOutput& output : outputs_) boundary_vertices += output.finish();
    return boundary_vertices;
  }

 private:
  const Engine& engine_;
  std::vector<StarOutput> outputs_;
  std::vector<StarCounter> counters_;
  HotStar hot_;
  std::vector<std::vector<StarCorner>> corners_;  // of the triangles in hand, by worker
  EarlyGroups<StarCorner> groups_;
};

StarTable::StarTable(const Engine& engine, const Plan& plan, const LastUses& last_faces,
                     GroupSinks& sinks)
    : impl_(std::make_unique<Impl>(engine, plan, last_faces, sinks)) {}
StarTable::~StarTable() = default;

void StarTable::add(std::size_t worker, std::span<const Triangle> triangles) {
  impl_->add(worker, triangles);
}
void StarTable::pass(std::uint64_t faces) {
  impl_->pass(faces);
}
void StarTable::settle() {
  impl_->settle();
}
std::uint64_t StarTable::finish() {
  return impl_->finish();
}

}  // namespace atlasgauge
