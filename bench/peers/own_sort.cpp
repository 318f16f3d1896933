// Brings half-edges together as the edge table does, on one thread; prints the edges.
//
//     own_sort FACES MEMORY_BYTES FOLDER

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <string>

#include "bench/peers/half_edges.hpp"
#include "stream/engine/keyed_groups.hpp"

namespace {

using namespace atlasgauge;

using Groups = KeyedGroups<PeerHalfEdge>;

std::uint64_t count_edges(const PeerGround& ground, std::uint64_t memory_bytes,
                          const std::string& folder) {
  MemoryBudget budget(memory_bytes);
  Scratch scratch({.directory = folder}, budget);
  const Workers workers(1);
  StageLog log(scratch, workers);
  const Engine engine{budget, scratch, workers, log};
  const auto fill = [&](auto push) {
    ground.for_each([&](const PeerHalfEdge& half_edge) { push(0, half_edge); });
  };
  Groups::Buckets buckets =
      Groups::distribute(engine, ground.half_edges(), ground.vertices(), "half-edges", fill);
  EdgeCount edges;
  const auto on_group = [&](std::size_t, std::span<PeerHalfEdge> group) {
    std::sort(group.begin(), group.end());
    for (const PeerHalfEdge& half_edge : group) edges.add(half_edge.lo, half_edge.hi);
  };
  const auto on_hot_key = [](std::uint32_t, Spill<PeerHalfEdge>) {
    throw std::logic_error("no vertex of the ground has many edges");
  };
  Groups(engine, on_group, on_hot_key).process(std::move(buckets));
  return edges.count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    const PeerGround ground(std::strtoull(argv[1], nullptr, 10));
    const std::uint64_t edges = count_edges(ground, std::strtoull(argv[2], nullptr, 10), argv[3]);
    std::printf("%ju\n", std::uintmax_t{edges});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
