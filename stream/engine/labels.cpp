#include "stream/engine/labels.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "stream/engine/gather.hpp"
#include "stream/engine/parity_forest.hpp"
#include "stream/engine/partition.hpp"

namespace atlasgauge {
namespace {

constexpr auto kConsumeLinks = SpillReader<Link>::Mode::kConsume;

template <class T, class Use>
void for_each_record(SpillReader<T> reader, Use use) {
  for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
    for (const T& record : block) use(record);
  }
}

/// A graph on [0, nodes), whose nodes stand for `names` of the original graph (ascending); no names
/// means that they are the original nodes.
struct Graph {
  std::uint64_t nodes = 0;
  Spill<Link> links;
  std::optional<Spill<std::uint32_t>> names;
  LinkRule rule = LinkRule::kManifoldOnly;
};

/// The links of a graph that count by its rule. Consumes them.
template <class Use>
void for_each_link(Graph& graph, Use use) {
  const LinkRule rule = graph.rule;
  for_each_record(SpillReader<Link>(graph.links, kConsumeLinks), [&](const Link& link) {
    if (rule == LinkRule::kAll) {
      use(Link(link.a(), link.b(), true, false));
    } else if (link.manifold()) {
      use(link);
    }
  });
}

/// Reads the names of a graph in node order.
class NameReader {
 public:
  explicit NameReader(std::optional<Spill<std::uint32_t>>& names) {
    if (names) reader_.emplace(*names);
  }
  std::uint32_t next() {
    if (!reader_) return next_++;
    std::uint32_t name = 0;
    reader_->read(name);
    return name;
  }

 private:
  std::optional<SpillReader<std::uint32_t>> reader_;
  std::uint32_t next_ = 0;
};

Spill<Label> label_in_memory(const Engine& engine, Graph graph) {
  const Reservation memory = engine.budget.reserve(
      graph.nodes * (graph.names ? 8 : 4) + 3 * engine.block_bytes(), "labelling in memory");
  ParityForest forest(graph.nodes);
  for_each_link(graph, [&](const Link& link) { forest.unite(link.a(), link.b(), link.parity()); });
  std::vector<std::uint32_t> names;
  if (graph.names) {
    names.resize(graph.nodes);
    SpillReader<std::uint32_t>(*graph.names).read(names);
  }
  SpillWriter<Label> labels(engine.scratch);
  for (std::uint32_t node = 0; node < graph.nodes; ++node) {
    const auto [root, parity] = forest.find(node);
    labels.push({names.empty() ? root : names[root], parity, forest.conflict(root)});
  }
  return labels.finish();
}

/// Blocks of the readers and writers beside the buckets.
constexpr std::uint64_t kBlocksBeside = 5;

/// Memory of one bucket a range of nodes, and of a few readers and writers beside them.
std::uint64_t bucket_bytes(const Engine& engine, std::uint64_t nodes, std::uint64_t range_nodes) {
  return ((nodes + range_nodes - 1) / range_nodes + kBlocksBeside) * engine.block_bytes();
}

/// What a range remembers of a node until the labels of the roots are known: the root inside the
/// range and the parity against it; for a root, whether it goes on to the next round, and whether
/// its set is in conflict (its own parity is always 0).
class NodeState {
 public:
  NodeState() = default;
  NodeState(std::uint32_t root, bool parity_or_conflict, bool active)
      : bits_(root | (parity_or_conflict ? kParity : 0) | (active ? kActive : 0)) {}
  std::uint32_t root() const { return bits_ & ~(kParity | kActive); }
  bool parity() const { return (bits_ & kParity) != 0; }
  bool conflict() const { return parity(); }
  bool active() const { return (bits_ & kActive) != 0; }

 private:
  static constexpr std::uint32_t kParity = std::uint32_t{1} << 30;
  static constexpr std::uint32_t kActive = std::uint32_t{1} << 31;
  std::uint32_t bits_ = 0;
};

/// One round by ranges. Links go to the range of their smaller end; ranges are worked on in
/// ascending order, so that when a range is reached all links into it from below have arrived,
/// their lower end renumbered already. Then it is known which of its roots have links out of the
/// range (are active), and they get the next dense numbers.
class RangeRound {
 public:
  /// Forest, dense numbers or final labels: bytes a node of one range.
  static constexpr std::uint64_t kNodeBytes = 8;

  RangeRound(const Engine& engine, Graph graph, std::uint64_t range_nodes)
      : engine_(engine),
        graph_(std::move(graph)),
        ranges_(detail::Slices{graph_.nodes, range_nodes}),
        states_(engine.scratch),
        upper_links_(engine.scratch),
        upper_names_(engine.scratch) {}

  /// Unites inside the ranges; returns the graph of the roots that have links between ranges.
  Graph contract() {
    distribute_links();
    for (std::size_t i = 0; i < ranges_.count(); ++i) {
      from_below_.emplace_back(engine_.scratch);
    }
    NameReader names(graph_.names);
    for (std::size_t i = 0; i < ranges_.count(); ++i) contract_range(i, names);
    from_below_.clear();
    states_done_ = states_.finish();
    return {next_dense_, upper_links_.finish(), upper_names_.finish(), LinkRule::kManifoldOnly};
  }

  /// Labels of all nodes, from the labels of the roots that contract() returned.
  Spill<Label> resolve(Spill<Label> upper) {
    SpillReader<Label> upper_reader(upper, SpillReader<Label>::Mode::kConsume);
    SpillReader<NodeState> states(states_done_, SpillReader<NodeState>::Mode::kConsume);
    NameReader names(graph_.names);
    SpillWriter<Label> labels(engine_.scratch);
    std::vector<Label> in_range;
    for (std::size_t i = 0; i < ranges_.count(); ++i) {
      in_range.resize(ranges_.end(i) - ranges_.begin(i));
      for (std::uint32_t node = 0; node < in_range.size(); ++node) {
        const std::uint32_t name = names.next();
        NodeState state;
        states.read(state);
        if (state.root() != node) {
          in_range[node] = in_range[state.root()].flipped(state.parity());
        } else if (!state.active()) {
          in_range[node] = {name, false, state.conflict()};
        } else {
          upper_reader.read(in_range[node]);
        }
      }
      labels.append(in_range);
    }
    return labels.finish();
  }

 private:
  void distribute_links() {
    std::vector<SpillWriter<Link>> writers;
    for (std::size_t i = 0; i < ranges_.count(); ++i) writers.emplace_back(engine_.scratch);
    for_each_link(graph_, [&](const Link& link) { writers[ranges_.of(link.a())].push(link); });
    for (auto& writer : writers) links_.push_back(writer.finish());
  }

  void contract_range(std::size_t range, NameReader& names) {
    const std::uint64_t begin = ranges_.begin(range);
    const std::uint64_t end = ranges_.end(range);
    const auto local = [begin](std::uint32_t node) {
      return static_cast<std::uint32_t>(node - begin);
    };
    ParityForest forest(end - begin);
    for_each_record(SpillReader<Link>(links_[range]), [&](const Link& link) {
      if (link.b() < end) forest.unite(local(link.a()), local(link.b()), link.parity());
    });

    std::vector<std::uint32_t> dense(end - begin, kNotActive);
    Spill<Below> below = from_below_[range].finish();
    for_each_record(SpillReader<Link>(links_[range]), [&](const Link& link) {
      if (link.b() >= end) dense[forest.find(local(link.a())).node] = 0;
    });
    for_each_record(SpillReader<Below>(below),
                    [&](const Below& link) { dense[forest.find(local(link.node)).node] = 0; });
    number_and_remember(forest, dense, names);

    for_each_record(SpillReader<Link>(links_[range], kConsumeLinks), [&](const Link& link) {
      if (link.b() < end) return;
      const auto [root, parity] = forest.find(local(link.a()));
      from_below_[ranges_.of(link.b())].push({dense[root], link.b(), link.parity() != parity});
    });
    for_each_record(SpillReader<Below>(below, SpillReader<Below>::Mode::kConsume),
                    [&](const Below& link) {
                      const auto [root, parity] = forest.find(local(link.node));
                      upper_links_.push({link.dense, dense[root], true, link.parity != parity});
                    });
  }

  void number_and_remember(ParityForest& forest, std::vector<std::uint32_t>& dense,
                           NameReader& names) {
    for (std::uint32_t node = 0; node < forest.size(); ++node) {
      const std::uint32_t name = names.next();
      const auto [root, parity] = forest.find(node);
      const bool active = root == node && dense[node] != kNotActive;
      states_.push({root, root == node ? forest.conflict(node) : parity, active});
      if (!active) continue;
      dense[node] = static_cast<std::uint32_t>(next_dense_++);
      upper_names_.push(name);
      if (forest.conflict(node)) upper_links_.push({dense[node], dense[node], true, true});
    }
  }

  static constexpr std::uint32_t kNotActive = ~std::uint32_t{0};

  /// A link whose lower end is renumbered already.
  struct Below {
    std::uint32_t dense;
    std::uint32_t node;
    bool parity;
  };

  const Engine& engine_;
  Graph graph_;
  detail::Slices ranges_;
  std::vector<Spill<Link>> links_;
  std::vector<SpillWriter<Below>> from_below_;
  SpillWriter<NodeState> states_;
  Spill<NodeState> states_done_;
  SpillWriter<Link> upper_links_;
  SpillWriter<std::uint32_t> upper_names_;
  std::uint64_t next_dense_ = 0;
};

/// One star round: every tail that has a head among its neighbours hooks onto the smallest of them.
/// Node numbers stay; hooked nodes are left without links.
class StarRound {
 public:
  StarRound(const Engine& engine, std::uint64_t nodes, std::uint64_t range_nodes,
            std::uint64_t round)
      : engine_(engine), ranges_(detail::Slices{nodes, range_nodes}), round_(round) {}

  Spill<Link> contract(Spill<Link> links) {
    choose_hooks(links);
    Spill<Hook> hooks_a = hooks_of(links, [](const Link& link) { return link.a(); });
    Spill<Hook> hooks_b = hooks_of(links, [](const Link& link) { return link.b(); });
    SpillReader<Hook> a(hooks_a, SpillReader<Hook>::Mode::kConsume);
    SpillReader<Hook> b(hooks_b, SpillReader<Hook>::Mode::kConsume);
    SpillWriter<Link> rewritten(engine_.scratch);
    for_each_record(SpillReader<Link>(links, kConsumeLinks), [&](const Link& link) {
      Hook hook_a{}, hook_b{};
      a.read(hook_a);
      b.read(hook_b);
      const bool parity = link.parity() ^ hook_a.parity() ^ hook_b.parity();
      if (hook_a.target() == hook_b.target() && !parity) return;
      rewritten.push({hook_a.target(), hook_b.target(), true, parity});
    });
    return rewritten.finish();
  }

  Spill<Label> resolve(Spill<Label> labels) {
    SpillWriter<std::uint32_t> targets(engine_.scratch);
    for_each_record(SpillReader<Hook>(hooks_), [&](Hook hook) { targets.push(hook.target()); });
    Spill<Label> of_target = gather(engine_, targets.finish(), labels, Label());
    labels.clear();
    SpillReader<Hook> hooks(hooks_, SpillReader<Hook>::Mode::kConsume);
    SpillWriter<Label> resolved(engine_.scratch);
    for_each_record(SpillReader<Label>(of_target, SpillReader<Label>::Mode::kConsume),
                    [&](Label label) {
                      Hook hook{};
                      hooks.read(hook);
                      resolved.push(label.flipped(hook.parity()));
                    });
    return resolved.finish();
  }

 private:
  /// The node that a node hooks onto (itself if none) and the parity between the two.
  struct Hook {
    std::uint32_t bits;
    std::uint32_t target() const { return bits >> 1; }
    bool parity() const { return (bits & 1) != 0; }
  };
  struct Directed {
    std::uint32_t from;
    Hook to;
  };

  /// Fibonacci hashing of the node and the round.
  bool is_tail(std::uint32_t node) const {
    std::uint64_t h = (node + 1) * 0x9E3779B97F4A7C15ULL + round_ * 0xD1B54A32D192ED03ULL;
    h ^= h >> 32;
    return ((h * 0x9E3779B97F4A7C15ULL) >> 63) != 0;
  }

  void choose_hooks(Spill<Link>& links) {
    const Reservation memory = engine_.budget.reserve(
        ranges_.length * 4 + bucket_bytes(engine_, ranges_.total, ranges_.length), "star round");
    std::vector<SpillWriter<Directed>> writers;
    for (std::size_t i = 0; i < ranges_.count(); ++i) writers.emplace_back(engine_.scratch);
    const auto offer = [&](std::uint32_t from, std::uint32_t to, bool parity) {
      if (!is_tail(from) || is_tail(to)) return;
      writers[ranges_.of(from)].push({from, {to << 1 | (parity ? 1U : 0U)}});
    };
    for_each_record(SpillReader<Link>(links), [&](const Link& link) {
      offer(link.a(), link.b(), link.parity());
      offer(link.b(), link.a(), link.parity());
    });
    SpillWriter<Hook> hooks(engine_.scratch);
    std::vector<std::uint32_t> best;
    for (std::size_t i = 0; i < ranges_.count(); ++i) {
      const std::uint64_t begin = ranges_.begin(i);
      best.assign(ranges_.end(i) - begin, ~std::uint32_t{0});
      Spill<Directed> offers = writers[i].finish();
      for_each_record(SpillReader<Directed>(offers), [&](const Directed& d) {
        std::uint32_t& bits = best[d.from - begin];
        bits = std::min(bits, d.to.bits);
      });
      for (std::size_t k = 0; k < best.size(); ++k) {
        const auto self = static_cast<std::uint32_t>((begin + k) << 1);
        hooks.push({best[k] == ~std::uint32_t{0} ? self : best[k]});
      }
    }
    hooks_ = hooks.finish();
  }

  template <class End>
  Spill<Hook> hooks_of(Spill<Link>& links, End end) {
    SpillWriter<std::uint32_t> nodes(engine_.scratch);
    for_each_record(SpillReader<Link>(links), [&](const Link& link) { nodes.push(end(link)); });
    return gather(engine_, nodes.finish(), hooks_, Hook{0});
  }

  const Engine& engine_;
  detail::Slices ranges_;
  std::uint64_t round_;
  Spill<Hook> hooks_;
};

/// Half of the memory for the nodes of a range, the other half for the buckets of links: that
/// serves the most nodes.
std::uint64_t range_nodes(std::uint64_t memory_bytes, std::size_t block_bytes) {
  const std::uint64_t beside_bytes = (kBlocksBeside + 1) * block_bytes;
  return std::max<std::uint64_t>(
      1024, (memory_bytes - std::min(memory_bytes, beside_bytes)) / 2 / RangeRound::kNodeBytes);
}

/// Runs the rounds. After a star round labels are right but no longer the smallest node.
class Labelling {
 public:
  explicit Labelling(const Engine& engine) : engine_(engine) {}

  bool needs_canonical() const { return star_used_; }

  Spill<Label> label(Graph graph, bool poor_locality) {
    if (fits(graph)) return label_in_memory(engine_, std::move(graph));
    const std::uint64_t per_range = nodes_per_range();
    std::optional<StarRound> star;
    if (poor_locality) {
      star_used_ = true;
      star.emplace(engine_, graph.nodes, per_range, ++rounds_);
      graph.links = star->contract(std::move(graph.links));
    }
    const std::uint64_t nodes = graph.nodes;
    RangeRound round(engine_, std::move(graph), per_range);
    Graph upper;
    {
      const Reservation memory = engine_.budget.reserve(
          per_range * RangeRound::kNodeBytes + bucket_bytes(engine_, nodes, per_range),
          "labelling by ranges");
      upper = round.contract();
    }
    const bool poor = upper.nodes > nodes / 4 * 3;
    Spill<Label> labels = round.resolve(label(std::move(upper), poor));
    return star ? star->resolve(std::move(labels)) : std::move(labels);
  }

 private:
  bool fits(const Graph& graph) const {
    const std::uint64_t bytes = graph.nodes * (graph.names ? 8 : 4);
    return bytes + 3 * engine_.block_bytes() <= engine_.budget.free_bytes();
  }

  std::uint64_t nodes_per_range() const {
    return range_nodes(engine_.budget.free_bytes(), engine_.block_bytes());
  }

  const Engine& engine_;
  bool star_used_ = false;
  std::uint64_t rounds_ = 0;
};

/// Makes the smallest node of every component its label, and parities relative to that node.
Spill<Label> canonical(const Engine& engine, Spill<Label> labels) {
  struct Member {
    std::uint32_t label, node_and_parity;
  };
  const std::uint64_t memory_bytes = engine.budget.free_bytes() / 2;
  const auto slices = detail::Slices::plan(labels.size(), 4, memory_bytes);
  Reservation memory = engine.budget.reserve(
      bucket_bytes(engine, slices.total, slices.length) + slices.length * 4, "naming components");
  std::vector<SpillWriter<Member>> writers;
  for (std::size_t i = 0; i < slices.count(); ++i) writers.emplace_back(engine.scratch);
  SpillWriter<std::uint32_t> indices(engine.scratch);
  std::uint32_t node = 0;
  for_each_record(SpillReader<Label>(labels), [&](Label label) {
    writers[slices.of(label.first())].push(
        {label.first(), node++ << 1 | (label.parity() ? 1U : 0U)});
    indices.push(label.first());
  });
  SpillWriter<std::uint32_t> firsts(engine.scratch);
  {
    std::vector<std::uint32_t> first;
    for (std::size_t i = 0; i < slices.count(); ++i) {
      first.assign(slices.end(i) - slices.begin(i), ~std::uint32_t{0});
      Spill<Member> members = writers[i].finish();
      for_each_record(SpillReader<Member>(members), [&](const Member& member) {
        std::uint32_t& smallest = first[member.label - slices.begin(i)];
        smallest = std::min(smallest, member.node_and_parity);
      });
      firsts.append(first);
    }
  }
  memory.release();
  Spill<std::uint32_t> table = firsts.finish();
  Spill<std::uint32_t> first_of_node = gather(engine, indices.finish(), table, std::uint32_t{0});
  SpillReader<std::uint32_t> reader(first_of_node, SpillReader<std::uint32_t>::Mode::kConsume);
  SpillWriter<Label> named(engine.scratch);
  for_each_record(SpillReader<Label>(labels, SpillReader<Label>::Mode::kConsume), [&](Label label) {
    std::uint32_t first = 0;
    reader.read(first);
    named.push({first >> 1, label.parity() != ((first & 1) != 0), label.conflict()});
  });
  return named.finish();
}

}  // namespace

Spill<Label> label_nodes(const Engine& engine, Spill<Link> links, std::uint64_t nodes,
                         LinkRule rule) {
  Labelling labelling(engine);
  Spill<Label> labels = labelling.label({nodes, std::move(links), std::nullopt, rule}, false);
  return labelling.needs_canonical() ? canonical(engine, std::move(labels)) : std::move(labels);
}

std::uint64_t label_capacity(std::uint64_t memory_bytes, std::size_t block_bytes) {
  const std::uint64_t nodes = range_nodes(memory_bytes, block_bytes);
  const std::uint64_t beside_bytes =
      nodes * RangeRound::kNodeBytes + kBlocksBeside * std::uint64_t{block_bytes};
  return nodes * ((memory_bytes - std::min(memory_bytes, beside_bytes)) / block_bytes);
}

std::uint64_t count_components(Spill<Label>& labels) {
  std::uint64_t node = 0;
  std::uint64_t components = 0;
  for_each_record(SpillReader<Label>(labels),
                  [&](Label label) { components += label.first() == node++ ? 1 : 0; });
  return components;
}

}  // namespace atlasgauge
