// What labelling the components of a graph costs a link.

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/permutation.hpp"
#include "bench/stages/bench_engine.hpp"
#include "bench/stages/job.hpp"
#include "stream/engine/labels.hpp"

namespace {

using namespace atlasgauge;

using Connect = std::function<void(std::uint32_t a, std::uint32_t b)>;

/// A graph whose components are known.
struct Graph {
  std::string name;
  std::uint32_t nodes;
  std::function<void(const Connect&)> for_each_link;
  std::function<std::uint32_t(std::uint32_t)> first_of;  ///< the smallest node of its component

  std::uint64_t links() const {
    std::uint64_t count = 0;
    for_each_link([&](std::uint32_t, std::uint32_t) { ++count; });
    return count;
  }
};

/// Paths of a thousand nodes, in order.
Graph paths(std::uint32_t nodes) {
  constexpr std::uint32_t kLength = 1000;
  return {"path", nodes,
          [=](const Connect& connect) {
            for (std::uint32_t i = 1; i < nodes; ++i) {
              if (i % kLength != 0) connect(i - 1, i);
            }
          },
          [](std::uint32_t i) { return i / kLength * kLength; }};
}

/// Squares of a lattice whose nodes lie row by row: neighbours above are a row away.
Graph grid(std::uint32_t about_nodes) {
  constexpr std::uint32_t kSquare = 64;
  const auto side = static_cast<std::uint32_t>(std::sqrt(about_nodes));
  return {"grid", side * side,
          [=](const Connect& connect) {
            for (std::uint32_t i = 0; i < side * side; ++i) {
              if (i % side % kSquare != 0) connect(i - 1, i);
              if (i / side % kSquare != 0) connect(i - side, i);
            }
          },
          [=](std::uint32_t i) {
            const std::uint32_t x = i % side, y = i / side;
            return y / kSquare * kSquare * side + x / kSquare * kSquare;
          }};
}

/// Trees: every node hangs on any node before it, as long as both leave the same remainder.
Graph random_trees(std::uint32_t nodes) {
  constexpr std::uint32_t kTrees = 64;
  return {"random", nodes,
          [=](const Connect& connect) {
            for (std::uint32_t i = kTrees; i < nodes; ++i) {
              const auto before = static_cast<std::uint32_t>(mix(i) % (i / kTrees));
              connect(before * kTrees + i % kTrees, i);
            }
          },
          [](std::uint32_t i) { return i % kTrees; }};
}

class LabelsJob : public Job {
 public:
  LabelsJob(const Graph& graph, Room room) : graph_(graph), room_(room) {}

  void prepare() override {
    links_ = {};
    labels_ = {};
    engine_ = std::make_unique<BenchEngine>(room_, kNodeBytes * graph_.nodes, 1);
    SpillWriter<Link> writer(engine_->engine().scratch);
    graph_.for_each_link([&](std::uint32_t a, std::uint32_t b) { writer.push({a, b}); });
    links_ = writer.finish();
  }
  void run() override {
    labels_ =
        label_nodes(engine_->engine(), std::move(links_), graph_.nodes, LinkRule::kManifoldOnly);
  }
  void check() override {
    expect(labels_.size() == graph_.nodes, "labels are missing");
    SpillReader<Label> reader(labels_);
    Label label;
    for (std::uint32_t i = 0; reader.read(label); ++i) {
      expect(label.first() == graph_.first_of(i), "a node is in another's component");
    }
    expect(engine_->kept_to_its_room(), "scratch is not where it should be");
  }

 private:
  /// What the program's union-find takes.
  static constexpr std::uint64_t kNodeBytes = 4;

  const Graph& graph_;
  Room room_;
  std::unique_ptr<BenchEngine> engine_;
  Spill<Link> links_;
  Spill<Label> labels_;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<Graph> graphs;
  const auto jobs = [&](std::uint64_t size) {
    const auto nodes = static_cast<std::uint32_t>(size);
    graphs = {paths(nodes), grid(nodes), random_trees(nodes)};
    std::vector<NamedJob> all;
    for (const Graph& graph : graphs) {
      for (const Room room : {Room::kInMemory, Room::kBeyondMemory}) {
        all.push_back({"labels/" + graph.name + "/" + name_of(room),
                       [=, &graph] { return std::make_unique<LabelsJob>(graph, room); }, "link",
                       graph.links()});
      }
    }
    return all;
  };
  return run_subject(argc, argv, {"NODES", 4'000'000, jobs});
}
