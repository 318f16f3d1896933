#include "measures/output/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes.hpp"

namespace atlasgauge {
namespace {

/// 1234567 as "1 234 567".
std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number < 0 ? -number : number);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), " ");
  }
  return number < 0 ? "-" + digits : digits;
}

std::string text_of(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_number()) return grouped(value.get<std::int64_t>());
  return value.get<std::string>();
}

/// One line: what it is, its value, and a word about it.
class Table {
 public:
  explicit Table(const Report& report) : report_(report) {}

  void title(std::string_view text) { text_ += fmt::format("\n{}\n", text); }
  void row(std::string_view what, const std::string& key, std::string_view note = "") {
    line(what, text_of(report_.at(key)), note);
  }
  void line(std::string_view what, std::string_view value, std::string_view note = "") {
    text_ += fmt::format("  {:<28}{:>18}", what, value);
    if (!note.empty()) text_ += fmt::format("  {}", note);
    text_ += '\n';
  }
  /// Only when there is something to say.
  void defect(std::string_view what, const std::string& key) {
    const Json value = report_.at(key);
    if (value.is_number() && value.get<double>() != 0) row(what, key);
  }
  void spread(std::string_view what, const std::string& prefix, std::string_view note = "") {
    text_ +=
        fmt::format("  {:<28}{:>18}{:>12}{:>12}{:>12}", what, text_of(report_.at(prefix + "_avg")),
                    text_of(report_.at(prefix + "_perc1")), text_of(report_.at(prefix + "_perc50")),
                    text_of(report_.at(prefix + "_perc99")));
    if (!note.empty()) text_ += fmt::format("  {}", note);
    text_ += '\n';
  }
  std::string take() { return std::move(text_); }

 private:
  const Report& report_;
  std::string text_;
};

void add_mesh(Table& table) {
  table.title("Mesh");
  table.row("faces", "fn");
  table.row("vertices", "vn");
  table.row("edges", "en");
  table.row("boundary edges", "en_b");
  table.row("area", "area", "model units squared");
  table.row("boundary length", "boundary_len", "model units");
  table.row("components", "connected_components");
  table.row("largest component", "largest_component_fn", "faces");
  table.row("boundary loops", "boundary_loops", "-1: not a manifold");
  table.row("genus", "genus", "-1: not a manifold");
  table.row("Euler characteristic", "euler");
  table.row("oriented / orientable", "oriented");
  table.row("", "orientable");
}

void add_defects(Table& table) {
  table.title("Defects (those found)");
  table.defect("non-manifold edges", "nonmanif_edge");
  table.defect("non-manifold vertices", "nonmanif_vert");
  table.defect("duplicate faces", "fndup");
  table.defect("zero-area faces", "fnzero");
  table.defect("degenerate faces", "fndegen");
  table.defect("duplicate positions", "vndup");
  table.defect("unreferenced vertices", "vnunref");
  table.defect("non-finite faces", "faces_nonfinite");
  table.defect("invalid faces", "faces_invalid");
  table.defect("null charts", "num_null_charts");
  table.defect("folded faces", "nfolds");
  table.defect("non-orientable charts", "charts_nonorientable");
  table.defect("faces without UV", "faces_unmapped");
  table.defect("faces without texture", "faces_untextured");
  table.defect("faces with UV outside 0..1", "faces_uv_outside");
}

void add_atlas(Table& table) {
  table.title("Atlas");
  table.row("textures", "ntex");
  table.row("charts", "num_charts");
  table.row("mapped fraction", "mapped_fraction", "of the area");
  table.row("occupancy", "occupancy", "of the texels of used textures");
  table.row("overlap within charts", "overlap_within_chart_texels", "texels");
  table.row("overlap between charts", "overlap_between_charts_texels", "texels");
  table.row("median chart", "chart_area_perc50", "texels squared");
  table.row("thin charts", "thin_charts_fraction", "of all charts, under 8 texels wide");
  table.row("UV area", "area_uv", "texels squared");
  table.row("UV boundary length", "boundary_len_uv", "texels");
  table.row("crumbliness", "crumbliness", "1 is best");
  table.row("solidity", "solidity", "1 is best");
  table.row("seam edges", "seam_edges");
  table.row("seam length", "seam_len", "model units");
  table.row("seam discrepancy", "seam_discrepancy_avg", "of 441; 0 is best");
}

void add_distributions(Table& table) {
  table.title("By area");
  table.line("", "average", "        1 %        50 %        99 %");
  table.spread("quasi-conformal distortion", "qcd", "1 is best");
  table.spread("UV scaling", "sf", "1 everywhere is best");
  table.spread("texel density", "texel_density", "texels per model unit");
  table.spread("smallest angle", "angle_min", "degrees");
}

/// Of this program alone: getrusage's maximum counts the caller's memory at the fork, too.
std::uint64_t peak_resident_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib << 10;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) << 10;
}

}  // namespace

std::string summary_of(const MeshFacts& facts, const Report& report) {
  Table table(report);
  table.line("model", facts.name);
  add_mesh(table);
  add_atlas(table);
  add_distributions(table);
  add_defects(table);
  if (!facts.quantizations.empty()) table.defect("cracks between quantized parts", "cracks");
  return table.take();
}

std::string cost_of(const Engine& engine, const MemoryPlan& plan, const MeshFacts& facts) {
  std::string text = fmt::format("\n{:<14}{:>9}{:>9}{:>9}{:>13}{:>13}{:>13}\n", "stage", "wall s",
                                 "CPU s", "workers", "spilled", "written", "read");
  for (const StageCost& stage : engine.log.stages()) {
    text += fmt::format("{:<14}{:>9.3f}{:>9.3f}{:>9}{:>13}{:>13}{:>13}\n", stage.name,
                        stage.wall_seconds, stage.cpu_seconds, stage.workers_busy,
                        format_bytes(stage.spilled_bytes), format_bytes(stage.written_bytes),
                        format_bytes(stage.read_bytes));
  }
  const auto line = [&](std::string_view what, std::uint64_t bytes, std::string_view note) {
    text += fmt::format("{:<26}{:>13}  {}\n", what, format_bytes(bytes), note);
  };
  const RasterWork& raster = facts.raster;
  text +=
      fmt::format("raster: {} tiles of up to {} texels, triangles drawn: {} scalar, {} osmesa\n",
                  raster.tiles, raster.tile_size, raster.triangles.scalar, raster.triangles.osmesa);
  text +=
      fmt::format("seams: {} images decoded, {} texels, {} sample pairs\n",
                  facts.seams.images_decoded, facts.seams.texels_decoded, facts.seams.sample_pairs);
  line("memory limit", plan.limit_bytes, plan.origin);
  line("engine budget", engine.budget.limit_bytes(), "");
  line("peak resident", peak_resident_bytes(), "");
  line("peak reserved", engine.budget.peak_bytes(), "");
  line("scratch alive at once", engine.scratch.peak_bytes(), "in memory and on disk");
  line("scratch spilled", engine.scratch.spilled_bytes(), "");
  line("scratch written", engine.scratch.written_bytes(), "");
  line("scratch read", engine.scratch.read_bytes(), "");
  return text;
}

}  // namespace atlasgauge
