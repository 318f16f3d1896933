#include "stream/seams/located_seams.hpp"

#include <tuple>
#include <utility>

#include "stream/engine/sort_spill.hpp"

namespace atlasgauge {
namespace {

bool by_vertices(const SeamEdge& a, const SeamEdge& b) {
  return std::tuple(raw(a.v[0]), raw(a.v[1])) < std::tuple(raw(b.v[0]), raw(b.v[1]));
}

Reservation reserve(const Engine& engine, const Spill<Position>& vertices) {
  const std::uint64_t least = 2 * engine.block_bytes() + 2 * PageLayout<Position>::kBytes;
  return engine.budget.reserve_between(least, least + vertices.size() * sizeof(Position),
                                       "positions of seams");
}

}  // namespace

LocatedSeams::LocatedSeams(const Engine& engine, Spill<SeamEdge> edges,
                           const Spill<Position>& vertices)
    : count_(edges.size()),
      edges_(sort_spill(engine, std::move(edges), by_vertices)),
      reader_(edges_, SpillReader<SeamEdge>::Mode::kConsume),
      memory_(reserve(engine, vertices)),
      vertices_(vertices, memory_.bytes() - 2 * engine.block_bytes()) {}

bool LocatedSeams::read(LocatedSeam& seam) {
  if (!reader_.read(seam.edge)) return false;
  for (int end = 0; end < 2; ++end) seam.p[end] = vertices_.at(raw(seam.edge.v[end]));
  return true;
}

}  // namespace atlasgauge
