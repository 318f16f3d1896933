#include "io/obj/obj_names.hpp"

#include <algorithm>

namespace atlasgauge {

std::uint32_t ObjNames::number_of(std::string_view name) {
  std::string key(name);
  // '\v' is a line end that a backslash took away.
  std::ranges::replace(key, '\v', ' ');
  if (const auto known = numbers_.find(key); known != numbers_.end()) return known->second;

  room_.add(key.size());
  const auto number = static_cast<std::uint32_t>(numbers_.size());
  numbers_.emplace(std::move(key), number);
  return number;
}

std::vector<std::string> ObjNames::take() {
  std::vector<std::string> names(numbers_.size());
  while (!numbers_.empty()) {
    auto node = numbers_.extract(numbers_.begin());
    names[node.mapped()] = std::move(node.key());
  }
  return names;
}

}  // namespace atlasgauge
