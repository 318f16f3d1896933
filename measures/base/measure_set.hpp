#pragma once

#include <memory>
#include <string>
#include <vector>

#include "measures/base/measure.hpp"

namespace atlasgauge {

/// One partial of every measure a worker, merged at the end.
class MeasureSet : public GroupSinks {
 public:
  explicit MeasureSet(std::size_t workers);

  GroupSink& of_worker(std::size_t worker) override;
  std::vector<std::string> distributions() const override;
  double cutoff(std::size_t distribution) const override;

  /// Merges the partials of all workers and finishes the measures.
  Report finish(const MeshFacts& facts);

 private:
  class Partials;
  std::vector<std::shared_ptr<Partials>> partials_;
};

}  // namespace atlasgauge
