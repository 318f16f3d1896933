#include "tests/support/oracle/seam_measures.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "tests/support/oracle/seams.hpp"
#include "tests/support/oracle/statistics.hpp"

namespace atlasgauge::oracle {
namespace {

using nlohmann::json;

constexpr size_t kWorst = 20;

void report_counts(json& report, const std::vector<Seam>& seams) {
  std::vector<double> lengths;
  lengths.reserve(seams.size());
  for (const Seam& seam : seams) lengths.push_back(seam.length_3d);
  report["seam_edges"] = seams.size();
  report["seam_len"] = rounded(exact_sum(lengths));
  report["seam_edges_unsampled"] =
      std::count_if(seams.begin(), seams.end(), [](const Seam& seam) { return !seam.sampled; });
}

using Value = std::optional<double> Seam::*;

Samples samples_of(const std::vector<Seam>& seams, Value value) {
  Samples samples;
  for (const Seam& seam : seams) {
    if (seam.*value) samples.push_back({*(seam.*value), seam.length_3d});
  }
  return samples;
}

json mean_or(const Samples& samples, const json& nothing) {
  return samples.empty() ? nothing : json(rounded(average(samples)));
}

json means_by_texture(const Model& model, const std::vector<Seam>& seams) {
  json means = json::array();
  for (size_t slot = 0; slot < model.slots.size(); ++slot) {
    const auto is_on_slot = [&](const SeamSide& side) {
      return side.slot == static_cast<int64_t>(slot);
    };
    std::vector<Seam> on_slot;
    std::copy_if(seams.begin(), seams.end(), std::back_inserter(on_slot), [&](const Seam& seam) {
      return std::any_of(seam.sides.begin(), seam.sides.end(), is_on_slot);
    });
    means.push_back(mean_or(samples_of(on_slot, &Seam::discrepancy), nullptr));
  }
  return means;
}

bool is_worse(const Seam& a, const Seam& b) {
  return std::tuple(-*a.discrepancy, -a.length_3d, a.vertices) <
         std::tuple(-*b.discrepancy, -b.length_3d, b.vertices);
}

json entry_of(const Model& model, const Seam& seam) {
  json sides = json::array();
  for (const SeamSide& side : seam.sides) {
    sides.push_back({{"texture", *side.slot}, {"uv_from", *side.uvs[0]}, {"uv_to", *side.uvs[1]}});
  }
  return {{"discrepancy", *seam.discrepancy},
          {"length_3d", seam.length_3d},
          {"samples", seam.samples},
          {"from", model.positions[static_cast<size_t>(seam.vertices.first)]},
          {"to", model.positions[static_cast<size_t>(seam.vertices.second)]},
          {"sides", sides}};
}

json worst_seams(const Model& model, std::vector<Seam> seams) {
  std::erase_if(seams, [](const Seam& seam) { return !seam.discrepancy; });
  std::sort(seams.begin(), seams.end(), is_worse);
  json worst = json::array();
  for (size_t i = 0; i < std::min(seams.size(), kWorst); ++i) {
    worst.push_back(entry_of(model, seams[i]));
  }
  return worst;
}

}  // namespace

void report_seams(json& report, const Analysis& analysis, bool texmetro) {
  const Model& model = analysis.model;
  const std::vector<Seam> seams = find_seams(analysis, texmetro);
  const json nothing = model.with_images && seams.empty() ? json(0.0) : json(nullptr);
  report_counts(report, seams);
  report_moments(report, "seam_discrepancy", samples_of(seams, &Seam::discrepancy), nothing);
  report["seam_discrepancy_by_texture"] = means_by_texture(model, seams);
  report["worst_seams"] = worst_seams(model, seams);
  if (!texmetro) return;
  report["seam_discrepancy_texmetro_avg"] =
      mean_or(samples_of(seams, &Seam::texmetro_discrepancy), nothing);
}

}  // namespace atlasgauge::oracle
