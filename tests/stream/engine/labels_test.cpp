#include "stream/engine/labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

using Links = std::vector<Link>;
using Numbering = std::vector<std::uint32_t>;

struct NaiveLabel {
  std::uint32_t first;
  bool parity, conflict;
};

/// Breadth first from every smallest node.
std::vector<NaiveLabel> naive_labels(const Links& links, std::uint32_t nodes, LinkRule rule) {
  std::vector<std::vector<std::pair<std::uint32_t, bool>>> neighbours(nodes);
  for (const Link& link : links) {
    if (rule == LinkRule::kManifoldOnly && !link.manifold()) continue;
    const bool parity = rule == LinkRule::kManifoldOnly && link.parity();
    neighbours[link.a()].emplace_back(link.b(), parity);
    neighbours[link.b()].emplace_back(link.a(), parity);
  }
  constexpr std::uint32_t kNobody = ~0U;
  std::vector<NaiveLabel> labels(nodes, {kNobody, false, false});
  for (std::uint32_t start = 0; start < nodes; ++start) {
    if (labels[start].first != kNobody) continue;
    labels[start].first = start;
    std::vector<std::uint32_t> queue{start};
    bool conflict = false;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const auto& [next, parity] : neighbours[queue[i]]) {
        const bool of_next = labels[queue[i]].parity != parity;
        if (labels[next].first == kNobody) {
          labels[next] = {start, of_next, false};
          queue.push_back(next);
        } else {
          conflict = conflict || labels[next].parity != of_next;
        }
      }
    }
    for (const std::uint32_t node : queue) labels[node].conflict = conflict;
  }
  return labels;
}

Numbering in_order(std::uint32_t nodes) {
  Numbering numbering(nodes);
  std::iota(numbering.begin(), numbering.end(), 0U);
  return numbering;
}

Numbering shuffled(std::uint32_t nodes) {
  Numbering numbering = in_order(nodes);
  std::shuffle(numbering.begin(), numbering.end(), std::mt19937(5));
  return numbering;
}

/// `pieces` paths, cut from one.
Links path(const Numbering& number, std::uint32_t pieces = 1) {
  Links links;
  const auto nodes = static_cast<std::uint32_t>(number.size());
  for (std::uint32_t i = 0; i + 1 < nodes; ++i) {
    if (i % (nodes / pieces) != nodes / pieces - 1) {
      links.emplace_back(number[i], number[i + 1], true, i % 3 == 0);
    }
  }
  return links;
}

/// Cycles of `length` nodes; all their links flip.
Links cycles(const Numbering& number, std::uint32_t length) {
  Links links;
  for (std::uint32_t i = 0; i + length <= number.size(); i += length) {
    for (std::uint32_t k = 0; k < length; ++k) {
      links.emplace_back(number[i + k], number[i + (k + 1) % length], true, true);
    }
  }
  return links;
}

Links stars(const Numbering& number, std::uint32_t leaves) {
  Links links;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    const std::uint32_t centre = i / (leaves + 1) * (leaves + 1);
    if (i != centre) links.emplace_back(number[centre], number[i], true, i % 2 == 1);
  }
  return links;
}

Links grid(const Numbering& number, std::uint32_t width) {
  Links links;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (i % width + 1 < width && i + 1 < number.size()) {
      links.emplace_back(number[i], number[i + 1], true, true);
    }
    if (i + width < number.size()) links.emplace_back(number[i], number[i + width], true, true);
  }
  return links;
}

/// `count` links between any two nodes; one in nine is not manifold.
Links random_links(std::uint32_t nodes, std::uint32_t count, bool parities) {
  std::mt19937 random(count);
  std::uniform_int_distribution<std::uint32_t> any(0, nodes - 1);
  Links links;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = any(random), b = any(random);
    links.emplace_back(a, b, i % 9 != 0, parities && a != b && random() % 2 == 0);
  }
  return links;
}

Links shuffled_links(Links links) {
  std::shuffle(links.begin(), links.end(), std::mt19937(9));
  return links;
}

/// Labels by one engine, against the naive ones.
class LabelsTest : public testing::TestWithParam<std::tuple<std::uint64_t, std::uint64_t>> {
 protected:
  void expect_labels(const Links& links, std::uint32_t nodes,
                     LinkRule rule = LinkRule::kManifoldOnly) {
    const auto [kib, resident_kib] = GetParam();
    TestEngine engine(
        {.budget_bytes = (kib + resident_kib) << 10, .resident_bytes = resident_kib << 10});
    Spill<Label> spill = label_nodes(engine, spill_of(engine, links), nodes, rule);
    const std::vector<Label> labels = records_of(spill);
    const std::vector<NaiveLabel> expected = naive_labels(links, nodes, rule);
    ASSERT_EQ(labels.size(), nodes);
    std::uint64_t components = 0;
    for (std::uint32_t node = 0; node < nodes; ++node) {
      ASSERT_EQ(labels[node].first(), expected[node].first) << "node " << node;
      ASSERT_EQ(labels[node].conflict(), expected[node].conflict) << "node " << node;
      if (!expected[node].conflict) {
        ASSERT_EQ(labels[node].parity(), expected[node].parity) << "node " << node;
      }
      components += expected[node].first == node ? 1 : 0;
    }
    EXPECT_EQ(count_components(spill), components);
    EXPECT_EQ(engine.budget.free_bytes(), kib << 10);
  }
};

constexpr std::uint32_t kNodes = 30000;

// 64 KiB is what a star round's gather needs: ranges of 4096 nodes, and at most 6656 nodes finish
// in memory, so 30000 nodes take several rounds, and star rounds where the numbering is random. 16
// MiB holds all.
INSTANTIATE_TEST_SUITE_P(BudgetsAndPools, LabelsTest,
                         testing::Values(std::tuple(100, 0), std::tuple(90, 40), std::tuple(160, 0),
                                         std::tuple(16384, 0)));

TEST_P(LabelsTest, NoNodes) {
  expect_labels({}, 0);
}

TEST_P(LabelsTest, NoLinks) {
  expect_labels({}, kNodes);
}

TEST_P(LabelsTest, PathInOrder) {
  expect_labels(path(in_order(kNodes)), kNodes);
}

TEST_P(LabelsTest, PathWithRandomNumbers) {
  expect_labels(path(shuffled(kNodes)), kNodes);
}

TEST_P(LabelsTest, PathBackwards) {
  Numbering backwards = in_order(kNodes);
  std::reverse(backwards.begin(), backwards.end());
  expect_labels(path(backwards), kNodes);
}

TEST_P(LabelsTest, PathAcrossTheRanges) {
  Numbering comb;
  for (std::uint32_t i = 0; i < kNodes; ++i) comb.push_back(i % 10 * (kNodes / 10) + i / 10);
  expect_labels(path(comb), kNodes);
}

TEST_P(LabelsTest, ManyPathsWithRandomNumbers) {
  expect_labels(shuffled_links(path(shuffled(kNodes), 100)), kNodes);
}

TEST_P(LabelsTest, OneStar) {
  expect_labels(stars(shuffled(kNodes), kNodes), kNodes);
}

TEST_P(LabelsTest, StarAroundTheLastNode) {
  Numbering last_first = in_order(kNodes);
  std::swap(last_first.front(), last_first.back());
  expect_labels(stars(last_first, kNodes), kNodes);
}

TEST_P(LabelsTest, ManyStars) {
  expect_labels(stars(shuffled(kNodes), 20), kNodes);
}

TEST_P(LabelsTest, GridInOrder) {
  expect_labels(grid(in_order(kNodes), 150), kNodes);
}

TEST_P(LabelsTest, GridWithRandomNumbers) {
  expect_labels(shuffled_links(grid(shuffled(kNodes), 150)), kNodes);
}

TEST_P(LabelsTest, RandomMatching) {
  expect_labels(path(shuffled(kNodes), kNodes / 2), kNodes);
}

TEST_P(LabelsTest, EvenCyclesAreNoConflict) {
  expect_labels(cycles(shuffled(kNodes), 10), kNodes);
}

TEST_P(LabelsTest, OddCyclesAreConflicts) {
  Links links = cycles(shuffled(kNodes), 5);
  const Links even = cycles(in_order(1000), 10);
  links.insert(links.end(), even.begin(), even.end());
  expect_labels(shuffled_links(links), kNodes);
}

TEST_P(LabelsTest, LongOddCycleIsAConflict) {
  expect_labels(cycles(shuffled(kNodes - 1), kNodes - 1), kNodes);
}

TEST_P(LabelsTest, SelfConflicts) {
  Links links = path(shuffled(kNodes), 1000);
  for (std::uint32_t node = 0; node < kNodes; node += 3001) {
    links.emplace_back(node, node, true, true);
  }
  expect_labels(shuffled_links(links), kNodes);
}

TEST_P(LabelsTest, SelfLinksOfEvenParitySayNothing) {
  Links links;
  for (std::uint32_t node = 0; node < kNodes; node += 7) links.emplace_back(node, node);
  expect_labels(links, kNodes);
}

TEST_P(LabelsTest, RepeatedLinksThatAgree) {
  Links links = path(shuffled(kNodes), 10);
  const Links again = links;
  links.insert(links.end(), again.begin(), again.end());
  expect_labels(shuffled_links(links), kNodes);
}

TEST_P(LabelsTest, RepeatedLinksThatDisagree) {
  Links links = path(shuffled(kNodes), 100);
  const Link some = links[links.size() / 2];
  links.emplace_back(some.a(), some.b(), true, !some.parity());
  expect_labels(links, kNodes);
}

TEST_P(LabelsTest, SparseRandomLinks) {
  expect_labels(random_links(kNodes, 12000, true), kNodes);
}

TEST_P(LabelsTest, CriticalRandomLinks) {
  expect_labels(random_links(kNodes, 17000, false), kNodes);
}

TEST_P(LabelsTest, DenseRandomLinks) {
  expect_labels(random_links(kNodes, 90000, true), kNodes);
}

TEST_P(LabelsTest, AllLinksCountWithoutTheirParities) {
  expect_labels(random_links(kNodes, 17000, true), kNodes, LinkRule::kAll);
}

TEST_P(LabelsTest, NodeCountsAroundARange) {
  for (const std::uint32_t nodes : {1U, 1023U, 1025U, 4095U, 4096U, 4097U, 8192U, 8193U, 13313U}) {
    expect_labels(path(shuffled(nodes)), nodes);
  }
}

TEST(LabelsInRangesTest, LocalGraphNeedsNoStarRound) {
  // Too little for the gather of a star round.
  TestEngine engine({.budget_bytes = 80 << 10});
  const Links links = grid(in_order(20000), 10);
  Spill<Label> labels =
      label_nodes(engine, spill_of(engine, links), 20000, LinkRule::kManifoldOnly);
  EXPECT_EQ(count_components(labels), 1U);
}

TEST(LinkTest, EndsAreInOrderWhateverTheFlags) {
  for (const bool manifold : {false, true}) {
    for (const bool parity : {false, true}) {
      const Link link(9, (1U << 30) - 1, manifold, parity),
          turned((1U << 30) - 1, 9, manifold, parity);
      for (const Link& l : {link, turned}) {
        EXPECT_EQ(l.a(), 9U);
        EXPECT_EQ(l.b(), (1U << 30) - 1);
        EXPECT_EQ(l.manifold(), manifold);
        EXPECT_EQ(l.parity(), parity);
      }
    }
  }
}

TEST(LabelTest, FlippingTwiceIsNothing) {
  const Label label((1U << 30) - 1, true, true);
  EXPECT_EQ(label.first(), (1U << 30) - 1);
  EXPECT_TRUE(label.parity());
  EXPECT_FALSE(label.flipped(true).parity());
  EXPECT_TRUE(label.flipped(true).conflict());
  EXPECT_TRUE(label.flipped(true).flipped(true).parity());
}

}  // namespace
}  // namespace atlasgauge
