#pragma once

#include <cstdint>

#include "bench/permutation.hpp"

namespace atlasgauge {

/// Where the items 0, 1, … of a model stand in its file.
class Numbering {
 public:
  enum class Kind {
    kInOrder,
    kStrided,   ///< neighbours always stand more than a third of the file apart
    kShuffled,  ///< at random
  };

  /// At most 2^32 items.
  Numbering(Kind kind, std::uint64_t items, std::uint64_t seed = 1);

  std::uint64_t item_at(std::uint64_t place) const {
    if (kind_ == Kind::kStrided) return place * stride_back_ % items_;
    return kind_ == Kind::kShuffled ? shuffle_(place) : place;
  }
  std::uint64_t place_of(std::uint64_t item) const {
    if (kind_ == Kind::kStrided) return item * stride_ % items_;
    return kind_ == Kind::kShuffled ? shuffle_.inverse(item) : item;
  }

 private:
  Kind kind_;
  std::uint64_t items_;
  std::uint64_t stride_ = 1;
  std::uint64_t stride_back_ = 1;  ///< stride * stride_back = 1 modulo items
  Permutation shuffle_;
};

}  // namespace atlasgauge
