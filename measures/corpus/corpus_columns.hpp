#pragma once

#include <cstddef>
#include <string>
#include <unordered_set>
#include <vector>

#include "measures/base/report.hpp"

namespace atlasgauge {

/// The columns that the objects of many models come to: a key for each value that is wanted. Keys
/// are in the order in which the objects have them; one that only some have comes after the one
/// that it follows there.
class CorpusColumns {
 public:
  /// Objects that others wrote may have any keys: there are so many columns at most.
  static constexpr std::size_t kMost = 4096;

  void add(const Json& object, bool (*is_wanted)(const Json& value));

  const std::vector<std::string>& keys() const { return keys_; }

 private:
  std::vector<std::string> keys_;
  std::unordered_set<std::string> known_;
};

}  // namespace atlasgauge
