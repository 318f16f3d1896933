#include "measures/corpus/corpus_columns.hpp"

#include <algorithm>

namespace atlasgauge {

void CorpusColumns::add(const Json& object, bool (*is_wanted)(const Json& value)) {
  auto place = keys_.begin();
  for (const auto& [key, value] : object.items()) {
    if (!is_wanted(value)) continue;
    if (known_.contains(key)) {
      const auto found = std::find(place, keys_.end(), key);
      if (found != keys_.end()) place = found + 1;
    } else if (keys_.size() < kMost) {
      known_.insert(key);
      place = keys_.insert(place, key) + 1;
    }
  }
}

}  // namespace atlasgauge
