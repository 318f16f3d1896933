#include "tests/support/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace atlasgauge {
namespace {

using nlohmann::json;

constexpr std::size_t kFullList = 20;

bool arrays_agree(const json& got, const json& want, double absolute) {
  return got.is_array() && got.size() == want.size() &&
         std::equal(got.begin(), got.end(), want.begin(),
                    [&](const json& a, const json& b) { return agree(a, b, absolute); });
}

bool objects_agree(const json& got, const json& want, double absolute) {
  if (!got.is_object() || got.size() != want.size()) return false;
  const auto items = want.items();
  return std::all_of(items.begin(), items.end(), [&](const auto& item) {
    return got.contains(item.key()) && agree(got.at(item.key()), item.value(), absolute);
  });
}

double discrepancy(const json& seam) {
  return seam.at("discrepancy").get<double>();
}

bool nearly_equal(const json& a, const json& b) {
  return agree(a.at("discrepancy"), b.at("discrepancy"), kDiscrepancy);
}

/// UVs are floats, by whatever digits they are written.
json with_uvs_as_floats(json seam) {
  for (json& side : seam.at("sides")) {
    for (const char* key : {"uv_from", "uv_to"}) {
      for (json& x : side.at(key)) x = x.get<float>();
    }
  }
  return seam;
}

bool seams_agree(const json& got, const json& want) {
  if (!nearly_equal(got, want)) return false;
  json of_want = with_uvs_as_floats(want);
  of_want["discrepancy"] = got.at("discrepancy");
  return agree(with_uvs_as_floats(got), of_want, 0);
}

/// Where the discrepancies end that nearly equal the one before them.
std::size_t end_of_run(const json& list, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < list.size() && nearly_equal(list[end - 1], list[end])) ++end;
  return end;
}

/// As far as rounding has no say in it.
bool order_is_certain(const json& list, std::size_t begin, std::size_t end) {
  return discrepancy(list[begin]) == discrepancy(list[end - 1]);
}

bool runs_agree(const json& got, const json& want, std::size_t begin, std::size_t end) {
  const auto at = [](const json& list, std::size_t i) {
    return list.begin() + static_cast<std::ptrdiff_t>(i);
  };
  if (std::equal(at(got, begin), at(got, end), at(want, begin), seams_agree)) return true;
  if (order_is_certain(got, begin, end) && order_is_certain(want, begin, end)) return false;
  if (end == kFullList) {
    return std::equal(at(got, begin), at(got, end), at(want, begin), nearly_equal);
  }
  return std::is_permutation(at(got, begin), at(got, end), at(want, begin), seams_agree);
}

}  // namespace

bool agree(const json& got, const json& want, double absolute) {
  if (want.is_array()) return arrays_agree(got, want, absolute);
  if (want.is_object()) return objects_agree(got, want, absolute);
  if (!got.is_number_float() && !want.is_number_float()) return got == want;
  if (!got.is_number() || !want.is_number()) return false;
  const double a = got.get<double>(), b = want.get<double>();
  return std::abs(a - b) <= std::max(absolute, kRelative * std::max(std::abs(a), std::abs(b)));
}

bool worst_seams_agree(const json& got, const json& want) {
  if (!got.is_array() || got.size() != want.size()) return false;
  for (std::size_t begin = 0, end = 0; begin < want.size(); begin = end) {
    end = end_of_run(want, begin);
    if (!runs_agree(got, want, begin, end)) return false;
  }
  return true;
}

}  // namespace atlasgauge
