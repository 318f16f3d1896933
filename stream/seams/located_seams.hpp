#pragma once

#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/page_cache.hpp"
#include "stream/engine/spill.hpp"
#include "stream/groups.hpp"

namespace atlasgauge {

/// Seam edges in the order of their vertices, with the positions of these. The first vertices come
/// in order; the second ones lie near them in a scan, and are read page by page where they do not.
class LocatedSeams : public SeamRows {
 public:
  LocatedSeams(const Engine& engine, Spill<SeamEdge> edges, const Spill<Position>& vertices);

  std::uint64_t count() const override { return count_; }
  bool read(LocatedSeam& seam) override;

 private:
  std::uint64_t count_;
  Spill<SeamEdge> edges_;
  SpillReader<SeamEdge> reader_;
  Reservation memory_;
  PageCache<Position> vertices_;
};

}  // namespace atlasgauge
