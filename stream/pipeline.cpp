#include "stream/pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "stream/mesh/charts.hpp"
#include "stream/mesh/components.hpp"
#include "stream/mesh/cracks.hpp"
#include "stream/mesh/edges.hpp"
#include "stream/mesh/stars.hpp"
#include "stream/mesh/triangles.hpp"
#include "stream/mesh/weld.hpp"
#include "stream/raster/atlas_raster.hpp"
#include "stream/seams/located_seams.hpp"
#include "stream/seams/null_charts.hpp"
#include "stream/seams/seam_sampling.hpp"

namespace atlasgauge {
namespace {

/// What one worker makes of triangles, besides half-edges.
struct TriangleOutput {
  std::vector<SampleStore::Writer> samples;
  std::vector<Sample> taken;
  std::vector<FaceLevels> levels;
  std::vector<AtlasFace> faces;
  std::vector<double> areas_3d;
  std::vector<float> distortions;
};

/// What the pass over all triangles leaves behind.
struct TriangleResults {
  std::unique_ptr<EdgeTable> edges;
  std::unique_ptr<StarTable> stars;
  Spill<FaceLevels> levels;  ///< in face order
  Spill<AtlasFace> faces;    ///< in face order
  Spill<double> areas_3d;    ///< in face order; empty unless asked for
  Spill<float> distortions;  ///< in face order; empty unless asked for
  std::vector<std::unique_ptr<SampleStore>> samples;
};

void take_samples(GroupSink& sink, std::span<const Triangle> triangles, TriangleOutput& output) {
  for (std::size_t i = 0; i < output.samples.size(); ++i) {
    output.taken.clear();
    sink.sample(i, triangles, output.taken);
    for (const Sample& sample : output.taken) output.samples[i].push(sample);
  }
}

void note_facts(std::span<const Triangle> triangles, const StreamOptions& options,
                TriangleOutput& output) {
  for (const Triangle& triangle : triangles) {
    output.levels.push_back(levels_of(triangle));
    output.faces.emplace_back(triangle);
    if (options.on_chart || options.distortion_of) output.areas_3d.push_back(triangle.area_3d);
    if (options.distortion_of) {
      output.distortions.push_back(static_cast<float>(options.distortion_of(triangle)));
    }
  }
}

template <class T>
void append_and_clear(SpillWriter<T>& writer, std::vector<T>& records) {
  writer.append(records);
  records.clear();
}

/// Parts that lie on grids of their own can come apart.
bool may_have_cracks(const std::vector<PartStart>& parts) {
  const auto is_quantized = [](const PartStart& part) { return part.position_step > 0; };
  return parts.size() > 1 && std::ranges::any_of(parts, is_quantized);
}

/// The tables get more than half of the memory: the less they spill. Half-edges take three times as
/// much as corners.
void make_tables(const Engine& engine, const StreamOptions& options, MeshStore& mesh,
                 const Weld& weld, const SlotFrames& frames, GroupSinks& sinks,
                 TriangleResults& results) {
  const std::uint64_t free_bytes = engine.budget.free_bytes();
  LastUses last_faces = std::exchange(mesh.last_faces, {});
  LastUses of_welded;
  if (weld.found_any()) of_welded = last_faces_of_welded(engine, last_faces, weld);
  EdgeTable::Plan plan{.welded = weld.found_any(),
                       .faces = mesh.faces.size(),
                       .vertices = mesh.positions.size(),
                       .memory_bytes = free_bytes / 8 * 3,
                       .keep_borders = static_cast<bool>(options.on_chart),
                       .keep_open = may_have_cracks(mesh.parts)};
  results.edges =
      EdgeTable::make(engine, plan, plan.welded ? of_welded : last_faces, frames, sinks);
  results.stars = std::make_unique<StarTable>(
      engine, StarTable::Plan{plan.faces, plan.vertices, free_bytes / 8}, last_faces, sinks);
}

TriangleResults stream_triangles(const Engine& engine, const StreamOptions& options,
                                 MeshStore& mesh, Weld& weld, const TextureSlots& slots,
                                 const SlotFrames& frames, GroupSinks& sinks) {
  StageLog::Stage stage(engine.log, "triangles", mesh.faces.size());
  const std::size_t workers = engine.workers.count();
  const std::size_t distributions = sinks.distributions().size();
  const Reservation writers_memory = engine.budget.reserve(
      distributions * Partition<Sample>::memory_bytes(1, workers, engine.block_bytes()) +
          8 * engine.block_bytes(),
      "samples and faces");
  TriangleResults results;
  make_tables(engine, options, mesh, weld, frames, sinks, results);
  for (std::size_t i = 0; i < distributions; ++i) {
    results.samples.push_back(std::make_unique<SampleStore>(engine.scratch));
  }
  std::vector<TriangleOutput> outputs(workers);
  for (TriangleOutput& output : outputs) {
    for (auto& store : results.samples) output.samples.emplace_back(*store);
  }
  SpillWriter<FaceLevels> levels(engine.scratch);
  SpillWriter<AtlasFace> faces(engine.scratch);
  SpillWriter<double> areas_3d(engine.scratch);
  SpillWriter<float> distortions(engine.scratch);
  TriangleVisitor visitor;
  visitor.transform = [&](std::size_t worker, std::span<const Triangle> triangles) {
    GroupSink& sink = sinks.of_worker(worker);
    sink.accept(triangles);
    take_samples(sink, triangles, outputs[worker]);
    note_facts(triangles, options, outputs[worker]);
    results.edges->add(worker, triangles);
    results.stars->add(worker, triangles);
  };
  visitor.commit = [&](std::size_t worker) {
    append_and_clear(levels, outputs[worker].levels);
    append_and_clear(faces, outputs[worker].faces);
    append_and_clear(areas_3d, outputs[worker].areas_3d);
    append_and_clear(distortions, outputs[worker].distortions);
    results.edges->pass(faces.size());
    results.stars->pass(faces.size());
  };
  visit_triangles(engine, mesh, weld, slots, frames, engine.budget.free_bytes() / 8 * 7, stage,
                  visitor);
  for (TriangleOutput& output : outputs) {
    for (auto& writer : output.samples) writer.flush();
  }
  results.edges->settle();
  results.stars->settle();
  results.levels = levels.finish();
  results.faces = faces.finish();
  results.areas_3d = areas_3d.finish();
  results.distortions = distortions.finish();
  return results;
}

void stream_components(const Engine& engine, EdgeResults& edges, Spill<FaceLevels>& levels,
                       GroupSinks& sinks) {
  StageLog::Stage stage(engine.log, "components", levels.size());
  FaceLabels labels(engine, std::move(edges.raw_links), levels.size(), edges.raw_manifold);
  group_components(engine, labels, levels, sinks);
}

std::uint64_t stream_boundary(const Engine& engine, EdgeResults& edges, std::uint64_t vertices,
                              std::uint64_t boundary_vertices) {
  StageLog::Stage stage(engine.log, "boundary", edges.boundary_links.size());
  return count_boundary_components(engine, std::move(edges.boundary_links), vertices,
                                   boundary_vertices);
}

/// What the charts leave behind.
struct ChartStage {
  Spill<Label> of_faces;  ///< the charts, in face order
  Spill<FaceId> null_faces;
};

ChartStage stream_charts(const Engine& engine, const StreamOptions& options, EdgeResults& edges,
                         TriangleResults& triangles, const SlotFrames& frames, GroupSinks& sinks) {
  StageLog::Stage stage(engine.log, "charts", triangles.faces.size());
  FaceLabels labels(engine, std::move(edges.uv_links), triangles.faces.size(), edges.uv_manifold);
  ChartParts parts{labels, triangles.faces, triangles.areas_3d, std::move(edges.borders)};
  const bool keep = static_cast<bool>(options.on_chart);
  ChartResults results =
      group_charts(engine, std::move(parts), frames, keep, sinks, triangles.samples);
  SpillReader<Chart> charts(results.charts, SpillReader<Chart>::Mode::kConsume);
  for (Chart chart; charts.read(chart);) options.on_chart(chart);
  return {std::move(labels.by_all_edges()), std::move(results.null_faces)};
}

SeamPlan plan_seams(const std::string& path, const StreamOptions& options) {
  return {.decode = {.model = path,
                     .open_image = options.open_image,
                     .spare_bytes = options.spare_bytes},
          .texmetro = options.texmetro_seams,
          .keep_edges = static_cast<bool>(options.on_seams)};
}

void stream_seams(const Engine& engine, const SeamPlan& plan, Spill<SeamCandidate> candidates,
                  Spill<FaceId> null_faces, const SlotFrames& frames, const StreamOptions& options,
                  Warnings& warnings, MeshFacts& facts, GroupSinks& sinks) {
  Spill<SeamCandidate> edges =
      drop_null_charts(engine, std::move(candidates), std::move(null_faces), facts.faces);
  SeamResults seams =
      sample_seams(engine, std::move(edges), facts.textures, frames, plan, warnings, sinks);
  facts.texture_seams = std::move(seams.textures);
  facts.seams = seams.work;
  facts.texmetro_seams = options.texmetro_seams;
  if (!options.on_seams) return;
  LocatedSeams rows(engine, std::move(seams.edges), facts.vertices);
  options.on_seams(rows);
}

std::map<std::string, Distribution> select_quantiles(
    const Engine& engine, GroupSinks& sinks, std::vector<std::unique_ptr<SampleStore>> stores) {
  const std::vector<std::string> names = sinks.distributions();
  StageLog::Stage stage(engine.log, "percentiles", names.size());
  std::map<std::string, Distribution> distributions;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto on_cut = [&](std::size_t worker, const Sample& sample) {
      sinks.of_worker(worker).cut(i, sample);
    };
    distributions.emplace(names[i],
                          select_up_to(engine, stores[i]->finish(), sinks.cutoff(i), on_cut));
    stage.progress(i + 1);
  }
  return distributions;
}

std::string name_of(std::span<const std::string> inputs) {
  const std::string first = std::filesystem::path(inputs.front()).filename().string();
  return inputs.size() == 1 ? first : fmt::format("{} and {} more", first, inputs.size() - 1);
}

std::uint64_t memory_bytes(const TextureSlots& textures) {
  return textures.memory_bytes() + SlotFrames::memory_bytes(textures.slots.size());
}

}  // namespace

MeshFacts stream_model(const Engine& engine, std::span<const std::string> inputs,
                       const StreamOptions& options, Warnings& warnings,
                       const ResolveTextures& resolve_textures, GroupSinks& sinks) {
  ReadModel read = read_model(engine, inputs, options.open_parts, warnings);
  MeshStore mesh = std::move(read.mesh);
  MeshFacts facts;
  facts.name = name_of(inputs);
  facts.faces = mesh.faces.size();
  facts.positions = mesh.positions.size();
  facts.invalid_polygons = mesh.invalid_polygons;
  facts.box = mesh.box;
  facts.textures = resolve_textures(read.materials);
  facts.quantizations = std::move(read.quantizations);
  read = {};
  const Reservation textures_memory =
      engine.budget.reserve(memory_bytes(facts.textures), "a model with so many textures");
  const SeamPlan seam_plan = plan_seams(inputs.front(), options);
  require_room_for_seams(engine, facts.textures, seam_plan.decode);

  Weld weld = weld_vertices(engine, mesh);
  facts.duplicate_positions = weld.duplicates;
  const SlotFrames frames = frame_slots(engine, mesh, weld, facts.textures);
  TriangleResults triangles =
      stream_triangles(engine, options, mesh, weld, facts.textures, frames, sinks);
  facts.vertices = std::move(mesh.positions);
  mesh.faces.clear();
  mesh.texcoords.clear();
  weld.welded.clear();

  const bool wants_maps = static_cast<bool>(options.distortion_of);
  EdgeResults edges = triangles.edges->finish();
  triangles.edges.reset();
  const std::uint64_t boundary_vertices = triangles.stars->finish();
  triangles.stars.reset();

  find_cracks(engine, std::move(edges.open), facts.vertices, mesh.parts, sinks);
  stream_components(engine, edges, triangles.levels, sinks);
  triangles.levels.clear();
  facts.boundary_components = stream_boundary(engine, edges, facts.positions, boundary_vertices);
  ChartStage charts = stream_charts(engine, options, edges, triangles, frames, sinks);
  if (!wants_maps) triangles.areas_3d.clear();
  if (!facts.textures.unit_slot) {
    RasterPlan plan = options.raster;
    plan.keep_faces = wants_maps;
    RasterResults raster =
        raster_atlas(engine, charts.of_faces, triangles.faces, frames, plan, sinks);
    facts.texture_levels = std::move(raster.levels);
    facts.raster = raster.work;
  }
  if (wants_maps) {
    facts.atlas = {std::move(charts.of_faces), std::move(triangles.faces),
                   std::move(triangles.areas_3d), std::move(triangles.distortions), frames};
  }
  charts.of_faces.clear();
  triangles.faces.clear();
  stream_seams(engine, seam_plan, std::move(edges.seams), std::move(charts.null_faces), frames,
               options, warnings, facts, sinks);
  facts.distributions = select_quantiles(engine, sinks, std::move(triangles.samples));
  return facts;
}

}  // namespace atlasgauge
