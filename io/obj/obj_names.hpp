#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/name_room.hpp"

namespace atlasgauge {

/// The distinct names in an OBJ, numbered in order of first use.
class ObjNames {
 public:
  explicit ObjNames(std::string path) : room_(std::move(path)) {}

  /// Throws Error(kResource) when there is no room for one more.
  std::uint32_t number_of(std::string_view name);

  /// Hands over the names in order.
  std::vector<std::string> take();

 private:
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view name) const {
      return std::hash<std::string_view>{}(name);
    }
  };

  NameRoom room_;
  std::unordered_map<std::string, std::uint32_t, Hash, std::equal_to<>> numbers_;
};

}  // namespace atlasgauge
