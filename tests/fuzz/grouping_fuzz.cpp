#include <algorithm>
#include <functional>
#include <map>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "stream/engine/gather.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/engine/labels.hpp"
#include "stream/engine/sort_spill.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/engine_fixture.hpp"

// Sorting, grouping, looking up and labelling out of core give what they give in memory, whatever
// the budget, the blocks, and the runs of keys; or they refuse for lack of memory.
namespace atlasgauge {
namespace {

struct Item {
  std::uint32_t kind, number;
  std::uint32_t key() const { return kind; }
  auto operator<=>(const Item&) const = default;
};

using Keys = std::vector<std::uint32_t>;
using Items = std::vector<Item>;

std::uint32_t scrambled(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7FEB352DU;
  x ^= x >> 15;
  x *= 0x846CA68BU;
  return x ^ x >> 16;
}

/// Runs of keys below `key_end`: equal, rising, falling, or scattered.
Keys draw_keys(FuzzedDataProvider& input, std::uint32_t key_end, std::size_t most) {
  Keys keys;
  while (input.remaining_bytes() > 0 && keys.size() < most && key_end > 0) {
    const auto step = input.PickValueInArray<std::uint32_t>({0, 1, 7, key_end - 1});
    const bool scatter = input.ConsumeBool();
    const auto count = input.ConsumeIntegralInRange<std::size_t>(1, 1500);
    auto key = input.ConsumeIntegralInRange<std::uint32_t>(0, key_end - 1);
    for (std::size_t i = 0; i < count && keys.size() < most; ++i) {
      keys.push_back(scatter ? scrambled(key) % key_end : key);
      key = static_cast<std::uint32_t>((std::uint64_t{key} + step) % key_end);
    }
  }
  return keys;
}

Items numbered(const Keys& keys) {
  Items items;
  for (const std::uint32_t key : keys) {
    items.push_back({key, static_cast<std::uint32_t>(items.size())});
  }
  return items;
}

void check_sort(TestEngine& engine, const Items& items) {
  Items want = items;
  std::sort(want.begin(), want.end());
  const Items got = records_of(sort_spill(engine, spill_of(engine, items), std::less<Item>()));
  fuzz::require(got == want, "a sorted spill is sorted and loses nothing");
}

void check_groups(TestEngine& engine, const Items& items, std::uint32_t key_end) {
  using Groups = KeyedGroups<Item>;
  auto buckets = Groups::distribute(engine, items.size(), key_end, "this test", [&](auto push) {
    for (const Item& item : items) push(0, item);
  });
  std::map<std::uint32_t, Items> got;
  bool repeated = false;
  std::mutex mutex;
  const auto take = [&](std::uint32_t key, Items group) {
    const std::lock_guard lock(mutex);
    std::sort(group.begin(), group.end());
    repeated = !got.emplace(key, std::move(group)).second || repeated;
  };
  Groups groups(
      engine,
      [&](std::size_t /*worker*/, std::span<Item> group) {
        take(group[0].kind, Items(group.begin(), group.end()));
      },
      [&](std::uint32_t key, Spill<Item> group) { take(key, records_of(group)); });
  groups.process(std::move(buckets));
  std::map<std::uint32_t, Items> want;
  for (const Item& item : items) want[item.kind].push_back(item);
  fuzz::require(!repeated, "a key has one group");
  fuzz::require(got == want, "groups hold what has their key");
}

void check_gather(TestEngine& engine, const Keys& indices, std::uint32_t table_size) {
  constexpr Item kAbsent{~0U, ~0U};
  Items table;
  for (std::uint32_t i = 0; i < table_size; ++i) table.push_back({i, scrambled(i)});
  Items want;
  for (const std::uint32_t i : indices) want.push_back(i < table.size() ? table[i] : kAbsent);
  Spill<Item> spilled = spill_of(engine, table);
  const Items got = records_of(gather(engine, spill_of(engine, indices), spilled, kAbsent));
  fuzz::require(got == want, "look-ups find what is at their index");
}

/// Links between neighbours in a list of nodes.
std::vector<Link> draw_links(FuzzedDataProvider& input, std::uint32_t nodes, std::size_t most) {
  const auto flips = input.ConsumeIntegral<std::uint32_t>();
  const auto gaps = input.ConsumeIntegral<std::uint32_t>();
  const Keys path = draw_keys(input, nodes, most);
  std::vector<Link> links;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i - 1] == path[i]) continue;
    links.emplace_back(path[i - 1], path[i], (gaps >> i % 32 & 1) == 0, (flips >> i % 31 & 1) != 0);
  }
  return links;
}

/// Union-find where every node knows its root's kind.
class NaiveLabels {
 public:
  explicit NaiveLabels(std::uint32_t nodes) : parent_(nodes), flip_(nodes), conflict_(nodes) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  void unite(std::uint32_t a, std::uint32_t b, bool parity) {
    const auto [root_a, flip_a] = find(a);
    const auto [root_b, flip_b] = find(b);
    const bool flip = flip_a != flip_b != parity;
    const auto [low, high] = std::minmax(root_a, root_b);
    if (low == high) {
      conflict_[low] = conflict_[low] || flip;
      return;
    }
    parent_[high] = low;
    flip_[high] = flip;
    conflict_[low] = conflict_[low] || conflict_[high];
  }

  Label of(std::uint32_t node) {
    const auto [root, flip] = find(node);
    return {root, flip, conflict_[root]};
  }

 private:
  std::pair<std::uint32_t, bool> find(std::uint32_t node) {
    bool flip = false;
    while (parent_[node] != node) {
      const std::uint32_t up = parent_[node];
      flip_[node] = flip_[node] != flip_[up];
      parent_[node] = parent_[up];
      flip = flip != flip_[node];
      node = parent_[node];
    }
    return {node, flip};
  }

  Keys parent_;
  std::vector<bool> flip_;
  std::vector<bool> conflict_;
};

void check_labels(TestEngine& engine, const std::vector<Link>& links, std::uint32_t nodes,
                  LinkRule rule) {
  NaiveLabels naive(nodes);
  for (const Link& link : links) {
    if (rule == LinkRule::kAll) naive.unite(link.a(), link.b(), false);
    if (rule == LinkRule::kManifoldOnly && link.manifold()) {
      naive.unite(link.a(), link.b(), link.parity());
    }
  }
  Spill<Label> spill = label_nodes(engine, spill_of(engine, links), nodes, rule);
  const std::vector<Label> labels = records_of(spill);
  fuzz::require(labels.size() == nodes, "every node has a label");
  std::uint64_t components = 0;
  bool agree = true;
  for (std::uint32_t node = 0; node < nodes; ++node) {
    const Label want = naive.of(node);
    const Label& got = labels[node];
    components += want.first() == node ? 1 : 0;
    agree = agree && got.first() == want.first() && got.conflict() == want.conflict() &&
            (got.conflict() || got.parity() == want.parity());
  }
  fuzz::require(agree, "nodes are labelled by component and kind");
  fuzz::require(count_components(spill) == components, "all components are counted");
}

EngineOptions draw_engine(FuzzedDataProvider& input) {
  EngineOptions options;
  options.block_bytes = input.PickValueInArray<std::size_t>({4096, 8192});
  options.workers = input.ConsumeIntegralInRange<std::size_t>(1, 3);
  const auto blocks = input.ConsumeIntegralInRange<std::size_t>(4, 40);
  options.budget_bytes = blocks * options.block_bytes;
  if (input.ConsumeBool()) {
    options.resident_bytes = input.ConsumeIntegralInRange<std::size_t>(0, options.budget_bytes);
  }
  return options;
}

void run(FuzzedDataProvider& input) {
  constexpr std::size_t kMostRecords = 6000;
  TestEngine engine(draw_engine(input));
  const auto key_end = input.ConsumeIntegralInRange<std::uint32_t>(
      1, input.PickValueInArray<std::uint32_t>({3, 200, 40000, 1U << 29}));
  const auto nodes = std::min<std::uint32_t>(key_end, 40000);
  switch (input.ConsumeIntegralInRange(0, 3)) {
    case 0:
      return check_sort(engine, numbered(draw_keys(input, key_end, kMostRecords)));
    case 1:
      return check_groups(engine, numbered(draw_keys(input, key_end, kMostRecords)), key_end);
    case 2:
      return check_gather(engine, draw_keys(input, key_end, kMostRecords),
                          input.ConsumeBool() ? nodes : nodes / 2);
    default: {
      const auto rule = input.PickValueInArray({LinkRule::kAll, LinkRule::kManifoldOnly});
      return check_labels(engine, draw_links(input, nodes, kMostRecords), nodes, rule);
    }
  }
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  FuzzedDataProvider input(data, bytes);
  try {
    atlasgauge::run(input);
  } catch (const atlasgauge::Error& error) {
    atlasgauge::fuzz::require(error.kind() == atlasgauge::ErrorKind::kResource, error.what());
  }
  return 0;
}
