// The program: what the command line asks for, as one flow from a model to a report. With
// stream/pipeline.cpp this is where the folders are put together; nothing else prints or exits.

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/command_line.hpp"
#include "io/cpu_limit.hpp"
#include "io/error.hpp"
#include "io/file/input_paths.hpp"
#include "io/file/output_file.hpp"
#include "io/file/output_folder.hpp"
#include "io/image/image_reader.hpp"
#include "io/open_parts.hpp"
#include "io/process/stop_signals.hpp"
#include "io/progress_bar.hpp"
#include "io/texture/texture_slots.hpp"
#include "io/warning_totals.hpp"
#include "io/warnings.hpp"
#include "measures/base/measure_set.hpp"
#include "measures/corpus/corpus.hpp"
#include "measures/mapping.hpp"
#include "measures/output/chart_table.hpp"
#include "measures/output/estimate_text.hpp"
#include "measures/output/seam_file.hpp"
#include "measures/output/summary.hpp"
#include "measures/process.hpp"
#include "stream/engine/engine.hpp"
#include "stream/estimate.hpp"
#include "stream/memory_plan.hpp"
#include "stream/pipeline.hpp"
#include "stream/raster/osmesa_raster.hpp"
#include "stream/raster/scalar_raster.hpp"

namespace atlasgauge {
namespace {

/// Standard error takes what it can; no run fails for it.
void remark(const char* text) {
  std::fputs(text, stderr);
}

MemoryPlan plan_for(const Options& options) {
  return plan_memory({options.memory_bytes, options.engine_memory_bytes, options.block_bytes,
                      options.threads, options.raster == RasterChoice::kOsmesa},
                     detect_cpu_limit().cpus);
}

/// The JSON of a file may take an eighth of the memory, and twice that while it is parsed.
OpenParts parts_for(const Options& options, const MemoryPlan& plan) {
  const PartOptions wanted{.lod = options.lod, .json_bytes = plan.engine_bytes / 8};
  return [wanted](const std::string& path, Warnings& warnings) {
    return open_parts(path, wanted, warnings);
  };
}

/// OSMesa is loaded here, so that a run does not find out late that it cannot be.
RasterPlan raster_for(const Options& options) {
  RasterPlan plan;
  plan.make = [] { return std::make_unique<ScalarRaster>(); };
  plan.tile_size = options.tile_texels.value_or(0);
  if (options.raster == RasterChoice::kScalar) return plan;
  make_osmesa_raster();
  plan.make = make_osmesa_raster;
  plan.largest_tile = kUsualOsmesaTile;
  return plan;
}

double distortion_of_any(const Triangle& triangle) {
  return is_mapped(triangle) ? quasi_conformal_distortion(triangle) : 0;
}

/// The text for people goes beside a JSON on standard output.
void write_text(const Options& options, const std::string& text) {
  if (options.quiet) return;
  options.json_path == "-" ? remark(text.c_str()) : write_file("-", text);
}

void estimate(const Options& options) {
  if (options.json_path) check_writable(*options.json_path);
  const MemoryPlan plan = plan_for(options);
  const std::vector<std::string> inputs = expand_input_paths(options.models);
  const ModelGuess guess = guess_model(inputs, {read_image_header, parts_for(options, plan)});
  const CostEstimate cost = estimate_cost(guess, plan);
  if (options.json_path) write_file(*options.json_path, json_of(guess, cost, plan).dump(1) + "\n");
  write_text(options, text_of(guess, cost, plan));
  require_resources(guess, cost, plan, options.tmp_dir);
}

/// What the s_f of maps are counted in, as the paper has it: sum A_uv / sum A_3d of all mapped
/// faces, which is the mean square of the texel density.
double scaling_unit(const Report& report) {
  const Json density = report.at("texel_density_rms");
  if (density.is_null()) return std::numeric_limits<double>::quiet_NaN();
  return density.get<double>() * density.get<double>();
}

void write_report(const std::string& path, const Report& report) {
  OutputFile file(path);
  report.write([&](std::string_view text) { file.append(text); });
  file.commit();
}

void measure(const Options& options) {
  if (options.json_path) check_writable(*options.json_path);
  if (options.maps_dir) make_output_folder(*options.maps_dir);
  const MemoryPlan plan = plan_for(options);
  const std::vector<std::string> inputs = expand_input_paths(options.models);
  const OpenParts open = parts_for(options, plan);
  require_resources_for(inputs, plan, options.tmp_dir, {read_image_header, open});
  const Workers workers(plan.workers);
  MemoryBudget budget(plan.engine_bytes);
  Scratch scratch({options.tmp_dir, plan.block_bytes, plan.resident_bytes, plan.queued_blocks},
                  budget);
  ProgressBar bar(!options.quiet && shows_progress(options.progress));
  StageLog log(scratch, workers,
               [&](const std::string& stage, double done) { bar.update(stage, done); });
  const Engine engine{budget, scratch, workers, log};
  Warnings warnings(
      [&](const std::string& text) {
        if (!options.quiet) bar.message("warning: " + text);
      },
      options.strict);

  MeasureSet measures(workers.count());
  const auto resolve = [&](std::span<const InputMaterials> materials) {
    return resolve_textures(materials, options.texture_size, read_image_header, warnings);
  };
  StreamOptions wanted;
  wanted.open_parts = open;
  wanted.raster = raster_for(options);
  std::optional<ChartTable> charts;
  if (options.charts_path) {
    charts.emplace(*options.charts_path);
    wanted.on_chart = [&](const Chart& chart) { charts->add(chart); };
  }
  std::unique_ptr<SeamFile> seams;
  if (options.seams_path) {
    seams = open_seam_file(*options.seams_path, options.texmetro_seams, engine);
    wanted.on_seams = [&](SeamRows& rows) { seams->write(rows); };
  }
  wanted.texmetro_seams = options.texmetro_seams;
  wanted.spare_bytes = plan.spare_bytes;
  if (options.maps_dir) wanted.distortion_of = distortion_of_any;
  MeshFacts facts = stream_model(engine, inputs, wanted, warnings, resolve, measures);
  const Report report = measures.finish(facts);
  if (options.maps_dir && facts.textures.unit_slot) {
    warnings.add("maps", inputs.front(), 0,
                 "there is no texture to map, as the model names no image; give a size with -t");
  } else if (options.maps_dir) {
    write_maps(engine, std::move(facts.atlas), facts.textures, scaling_unit(report),
               *options.maps_dir);
  }
  bar.clear();
  if (charts) charts->commit();
  if (seams) seams->commit();
  if (options.json_path) write_report(*options.json_path, report);
  write_text(options, summary_of(facts, report));
  if (!options.quiet) remark(warnings_line(warnings.totals()).c_str());
  if (options.verbose) remark(cost_of(engine, plan, facts).c_str());
}

/// The commands of `corpus`, by the kind of their options.
struct CorpusCommands {
  int operator()(const CorpusPlanOptions& options) const { return plan_corpus(options); }
  int operator()(const CorpusProbeOptions& options) const { return probe_corpus(options); }
  int operator()(const CorpusRunOptions& options) const { return run_corpus(options); }
  int operator()(const CorpusStatusOptions& options) const { return show_corpus(options); }
  int operator()(const CorpusGatherOptions& options) const { return gather_corpus(options); }
};

int run(const std::vector<std::string>& arguments) {
  const CommandLine line = parse_command_line(arguments);
  if (line.text) {
    write_file("-", *line.text);
    return 0;
  }
  if (line.corpus) return std::visit(CorpusCommands(), *line.corpus);
  line.options.estimate ? estimate(line.options) : measure(line.options);
  return 0;
}

/// Needs no memory, as there may be none.
int fail(ErrorKind kind, const char* text) {
  remark("atlasgauge: ");
  remark(text);
  remark("\n");
  return static_cast<int>(kind);
}

/// Tells what is being caught; returns the exit code.
int tell_caught() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return fail(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::kResource,
                "the system gives no more memory; free some, or give less with --memory");
  } catch (const std::exception& error) {
    remark("atlasgauge: internal error, please report it\n");
    return fail(ErrorKind::kInternal, error.what());
  } catch (...) {
    return fail(ErrorKind::kInternal, "internal error, please report it");
  }
}

/// For errors where none can pass: libraries allocate even in destructors.
[[noreturn]] void end_at_once() noexcept {
  const bool caught = std::current_exception() != nullptr;
  ::_exit(caught ? tell_caught() : fail(ErrorKind::kInternal, "internal error, please report it"));
}

}  // namespace
}  // namespace atlasgauge

int main(int argc, char** argv) {
  std::set_terminate(atlasgauge::end_at_once);
  try {
    atlasgauge::prepare_process();
    const int code = atlasgauge::run(std::vector<std::string>(argv + 1, argv + argc));
    if (code > 128) atlasgauge::die_by(code - 128);
    return code;
  } catch (...) {
    return atlasgauge::tell_caught();
  }
}
