#include "bench/worst_cases.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/worst/families.hpp"
#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kFewestFaces = 100;
/// UVs are whole numbers up to the size, and floats hold these to 2^24.
constexpr std::uint64_t kMostFaces = std::uint64_t{1} << 24;
/// Longer than any word that the program takes.
constexpr std::uint64_t kShortestLongLine = 80'000;

std::vector<WorstCase> all_cases() {
  std::vector<WorstCase> all;
  for (const auto family : {site_cases, star_cases, strip_cases, collapse_cases, duplicate_cases,
                            material_cases, long_line_cases, number_cases, atlas_cases}) {
    const std::vector<WorstCase> cases = family();
    all.insert(all.end(), cases.begin(), cases.end());
  }
  return all;
}

void check_size(const WorstCase& worst_case, std::uint64_t size) {
  const bool is_site = worst_case.name.starts_with("site");
  const bool is_line = worst_case.unit == "bytes";
  const std::uint64_t least = is_line ? kShortestLongLine : kFewestFaces;
  const std::uint64_t most = is_line || is_site ? ~std::uint64_t{0} : kMostFaces;
  if (size >= least && size <= most) return;
  throw Error(ErrorKind::kUsage, fmt::format("{} can have from {} to {} {}, not {}",
                                             worst_case.name, least, most, worst_case.unit, size));
}

}  // namespace

const std::vector<WorstCase>& worst_cases() {
  static const std::vector<WorstCase> cases = all_cases();
  return cases;
}

const WorstCase& worst_case_of(std::string_view name) {
  const auto found = std::ranges::find(worst_cases(), name, &WorstCase::name);
  if (found != worst_cases().end()) return *found;
  throw Error(ErrorKind::kUsage, fmt::format("there is no case {}; --list shows them", name));
}

Answers worst_case_answers(const WorstCase& worst_case, std::uint64_t size) {
  if (!worst_case.refusal.empty()) return {};
  Answers answers = worst_case.answers(size);
  answers.values["mesh"] = fmt::format("{}.obj", worst_case.name);
  return answers;
}

void write_worst_case(const WorstCase& worst_case, std::uint64_t size,
                      const std::string& directory) {
  check_size(worst_case, size);
  const std::string stem = fmt::format("{}/{}", directory, worst_case.name);
  worst_case.write(size, stem);
  write_answers(worst_case_answers(worst_case, size), stem + ".answers.json");
}

}  // namespace atlasgauge
