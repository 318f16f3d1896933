#include "tests/support/oracle/oracle.hpp"

#include <utility>
#include <vector>

#include "tests/support/oracle/atlas_measures.hpp"
#include "tests/support/oracle/levels.hpp"
#include "tests/support/oracle/mesh_measures.hpp"
#include "tests/support/oracle/raster.hpp"
#include "tests/support/oracle/scale_measures.hpp"
#include "tests/support/oracle/seam_measures.hpp"

namespace atlasgauge::oracle {

nlohmann::json measure(Model model, bool texmetro_seams) {
  const Analysis analysis = analyse(std::move(model));
  const std::vector<SlotCounts> slots = raster_slots(analysis);
  nlohmann::json report;
  report_mesh(report, analysis);
  report_atlas(report, analysis);
  report_seams(report, analysis, texmetro_seams);
  report_raster(report, analysis, slots);
  report_scale(report, analysis, coverage_of(analysis, slots));
  return report;
}

nlohmann::json measure_obj(const std::string& obj_path, const Options& options) {
  return measure(read_obj(obj_path, options), options.texmetro_seams);
}

}  // namespace atlasgauge::oracle
