#include "stream/pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "stream/mesh/charts.hpp"
#include "stream/mesh/components.hpp"
#include "stream/mesh/edges.hpp"
#include "stream/mesh/seams.hpp"
#include "stream/mesh/stars.hpp"
#include "stream/mesh/triangles.hpp"
#include "stream/mesh/weld.hpp"

namespace atlasgauge {
namespace {

/// What one worker makes of triangles, besides half-edges.
struct TriangleOutput {
  std::vector<SampleStore::Writer> samples;
  std::vector<Sample> taken;
  std::vector<FaceFacts> facts;
  double largest_area_uv = 0;
};

/// What the pass over all triangles leaves behind.
struct TriangleResults {
  std::unique_ptr<EdgeTable> edges;
  Spill<FaceFacts> facts;  ///< in face order
  std::vector<std::unique_ptr<SampleStore>> samples;
  double largest_area_uv = 0;
};

void take_samples(GroupSink& sink, std::span<const Triangle> triangles, TriangleOutput& output) {
  for (std::size_t i = 0; i < output.samples.size(); ++i) {
    output.taken.clear();
    sink.sample(i, triangles, output.taken);
    for (const Sample& sample : output.taken) output.samples[i].push(sample);
  }
}

void note_facts(std::span<const Triangle> triangles, TriangleOutput& output) {
  output.facts.clear();
  for (const Triangle& triangle : triangles) {
    output.facts.emplace_back(triangle);
    output.largest_area_uv = std::max(output.largest_area_uv, std::abs(triangle.area_uv));
  }
}

TriangleResults stream_triangles(const Engine& engine, MeshStore& mesh, Weld& weld,
                                 const TextureSlots& slots, const SlotFrames& frames,
                                 GroupSinks& sinks) {
  StageLog::Stage stage(engine.log, "triangles", mesh.faces.size());
  const std::size_t workers = engine.workers.count();
  const std::size_t distributions = sinks.distributions().size();
  const Reservation writers_memory = engine.budget.reserve(
      distributions * Partition<Sample>::memory_bytes(1, workers, engine.block_bytes()) +
          6 * engine.block_bytes(),
      "samples and face facts");
  TriangleResults results;
  results.edges = EdgeTable::make(engine, weld.found_any(), mesh.faces.size(),
                                  mesh.positions.size(), engine.budget.free_bytes() / 2);
  for (std::size_t i = 0; i < distributions; ++i) {
    results.samples.push_back(std::make_unique<SampleStore>(engine.scratch));
  }
  std::vector<TriangleOutput> outputs(workers);
  for (TriangleOutput& output : outputs) {
    for (auto& store : results.samples) output.samples.emplace_back(*store);
  }
  SpillWriter<FaceFacts> facts(engine.scratch);
  TriangleVisitor visitor;
  visitor.transform = [&](std::size_t worker, std::span<const Triangle> triangles) {
    GroupSink& sink = sinks.of_worker(worker);
    sink.accept(triangles);
    take_samples(sink, triangles, outputs[worker]);
    note_facts(triangles, outputs[worker]);
    results.edges->add(worker, triangles, frames);
  };
  visitor.commit = [&](std::size_t worker) { facts.append(outputs[worker].facts); };
  visit_triangles(engine, mesh, weld, slots, frames, engine.budget.free_bytes() / 8 * 7, stage,
                  visitor);
  for (TriangleOutput& output : outputs) {
    for (auto& writer : output.samples) writer.flush();
    results.largest_area_uv = std::max(results.largest_area_uv, output.largest_area_uv);
  }
  results.facts = facts.finish();
  return results;
}

void stream_components(const Engine& engine, EdgeResults& edges, Spill<FaceFacts>& facts,
                       GroupSinks& sinks) {
  StageLog::Stage stage(engine.log, "components", facts.size());
  FaceLabels labels(engine, std::move(edges.raw_links), facts.size(), edges.raw_manifold);
  group_components(engine, labels, facts, sinks);
}

std::uint64_t stream_boundary(const Engine& engine, EdgeResults& edges, std::uint64_t vertices,
                              std::uint64_t boundary_vertices) {
  StageLog::Stage stage(engine.log, "boundary", edges.boundary_links.size());
  return count_boundary_components(engine, std::move(edges.boundary_links), vertices,
                                   boundary_vertices);
}

Spill<FaceId> stream_charts(const Engine& engine, EdgeResults& edges, Spill<FaceFacts>& facts,
                            double largest_area_uv, GroupSinks& sinks) {
  StageLog::Stage stage(engine.log, "charts", facts.size());
  FaceLabels labels(engine, std::move(edges.uv_links), facts.size(), edges.uv_manifold);
  return group_charts(engine, labels, facts, largest_area_uv, sinks);
}

std::map<std::string, Quantiles> select_quantiles(
    const Engine& engine, const std::vector<std::string>& names,
    std::vector<std::unique_ptr<SampleStore>> stores) {
  StageLog::Stage stage(engine.log, "percentiles", names.size());
  std::map<std::string, Quantiles> quantiles;
  for (std::size_t i = 0; i < names.size(); ++i) {
    quantiles.emplace(names[i], stores[i]->select(engine));
    stage.progress(i + 1);
  }
  return quantiles;
}

std::uint64_t memory_bytes(const TextureSlots& textures) {
  return textures.memory_bytes() + SlotFrames::memory_bytes(textures.slots.size());
}

}  // namespace

MeshFacts stream_model(const Engine& engine, const std::string& path, Warnings& warnings,
                       const ResolveTextures& resolve_textures, GroupSinks& sinks) {
  ObjSummary summary;
  MeshStore mesh = read_mesh(engine, path, warnings, summary);
  MeshFacts facts;
  facts.name = std::filesystem::path(path).filename().string();
  facts.faces = mesh.faces.size();
  facts.positions = mesh.positions.size();
  facts.invalid_polygons = mesh.invalid_polygons;
  facts.box = mesh.box;
  facts.textures = resolve_textures(summary);
  summary = {};
  const Reservation textures_memory =
      engine.budget.reserve(memory_bytes(facts.textures), "a model with so many textures");

  Weld weld = weld_vertices(engine, mesh);
  facts.duplicate_positions = weld.duplicates;
  const SlotFrames frames = frame_slots(engine, mesh, weld, facts.textures);
  TriangleResults triangles = stream_triangles(engine, mesh, weld, facts.textures, frames, sinks);
  mesh.positions.clear();
  mesh.texcoords.clear();
  weld.welded.clear();

  EdgeResults edges = triangles.edges->group(frames, sinks);
  triangles.edges.reset();
  const std::uint64_t boundary_vertices =
      group_stars(engine, mesh.faces, triangles.facts, facts.positions, sinks);
  mesh.faces.clear();

  stream_components(engine, edges, triangles.facts, sinks);
  facts.boundary_components = stream_boundary(engine, edges, facts.positions, boundary_vertices);
  Spill<FaceId> null_faces =
      stream_charts(engine, edges, triangles.facts, triangles.largest_area_uv, sinks);
  triangles.facts.clear();
  group_seams(engine, std::move(edges.seams), std::move(null_faces), facts.faces, sinks);
  facts.quantiles = select_quantiles(engine, sinks.distributions(), std::move(triangles.samples));
  return facts;
}

}  // namespace atlasgauge
