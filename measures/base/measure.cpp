#include "measures/base/measure.hpp"

#include <algorithm>

namespace atlasgauge {
namespace {

/// Filled before main() by the Registered objects, read-only from then on.
std::vector<std::unique_ptr<AnyMeasure>>& prototypes() {
  static std::vector<std::unique_ptr<AnyMeasure>> list;
  return list;
}

}  // namespace

void register_measure(std::unique_ptr<AnyMeasure> prototype) {
  prototypes().push_back(std::move(prototype));
}

std::vector<std::unique_ptr<AnyMeasure>> all_measures() {
  std::vector<std::unique_ptr<AnyMeasure>> measures;
  for (const auto& prototype : prototypes()) measures.push_back(prototype->fresh());
  std::sort(measures.begin(), measures.end(),
            [](const auto& a, const auto& b) { return a->name() < b->name(); });
  return measures;
}

}  // namespace atlasgauge
