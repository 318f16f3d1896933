#include "io/json/json_view.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

JsonView::JsonView(const nlohmann::json& document, const std::string& path)
    : value_(&document), path_(&path) {}

JsonView::JsonView(const nlohmann::json& value, const std::string& path, std::string place)
    : value_(&value), path_(&path), place_(std::move(place)) {}

std::optional<JsonView> JsonView::find(const char* key) const {
  if (!value_->is_object()) refuse("expected an object");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonView(*found, *path_, place_.empty() ? key : place_ + "." + key);
}

JsonView JsonView::at(const char* key) const {
  std::optional<JsonView> found = find(key);
  if (!found) refuse(fmt::format("\"{}\" is missing", key));
  return *std::move(found);
}

JsonElements JsonView::elements(const char* key) const {
  return JsonElements(find(key));
}

std::vector<std::string> JsonView::keys() const {
  if (!value_->is_object()) refuse("expected an object");
  std::vector<std::string> names;
  for (const auto& member : value_->items()) names.push_back(member.key());
  return names;
}

bool JsonView::is_object() const {
  return value_->is_object();
}

/// Some exporters write whole numbers as "3.0".
std::uint64_t JsonView::whole() const {
  constexpr double kMostExact = 9007199254740992;  // 2^53
  if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
  if (value_->is_number_float()) {
    const auto number = value_->get<double>();
    const bool is_whole = number >= 0 && number <= kMostExact && std::floor(number) == number;
    if (is_whole) return static_cast<std::uint64_t>(number);
  }
  refuse("expected a whole number that is not negative");
}

std::uint32_t JsonView::index() const {
  const std::uint64_t number = whole();
  if (number >= std::numeric_limits<std::uint32_t>::max()) refuse("expected an index of 32 bits");
  return static_cast<std::uint32_t>(number);
}

double JsonView::number() const {
  if (!value_->is_number()) refuse("expected a number");
  return value_->get<double>();
}

bool JsonView::flag() const {
  if (!value_->is_boolean()) refuse("expected true or false");
  return value_->get<bool>();
}

const std::string& JsonView::text() const {
  if (!value_->is_string()) refuse("expected a text");
  return value_->get_ref<const std::string&>();
}

std::vector<double> JsonView::numbers(std::size_t count) const {
  if (!value_->is_array() || value_->size() != count) {
    refuse(fmt::format("expected {} numbers", count));
  }
  std::vector<double> result;
  for (const nlohmann::json& element : *value_) {
    if (!element.is_number()) refuse(fmt::format("expected {} numbers", count));
    result.push_back(element.get<double>());
  }
  return result;
}

std::uint64_t JsonView::whole_or(const char* key, std::uint64_t otherwise) const {
  const std::optional<JsonView> member = find(key);
  return member ? member->whole() : otherwise;
}

bool JsonView::flag_or(const char* key, bool otherwise) const {
  const std::optional<JsonView> member = find(key);
  return member ? member->flag() : otherwise;
}

std::string JsonView::text_or(const char* key, const char* otherwise) const {
  const std::optional<JsonView> member = find(key);
  return member ? member->text() : otherwise;
}

void JsonView::refuse(const std::string& text) const {
  throw Error(ErrorKind::kInput, *path_, 0, (place_.empty() ? "the JSON" : place_) + ": " + text);
}

JsonElements::JsonElements(std::optional<JsonView> array) : array_(std::move(array)) {
  if (array_ && !array_->value_->is_array()) array_->refuse("expected an array");
}

std::size_t JsonElements::size() const {
  return array_ ? array_->value_->size() : 0;
}

JsonView JsonElements::operator[](std::size_t index) const {
  return {(*array_->value_)[index], *array_->path_, fmt::format("{}[{}]", array_->place_, index)};
}

}  // namespace atlasgauge
