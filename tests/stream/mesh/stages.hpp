#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "stream/groups.hpp"
#include "stream/mesh/charts.hpp"
#include "stream/mesh/components.hpp"
#include "stream/mesh/edges.hpp"
#include "stream/mesh/stars.hpp"
#include "stream/mesh/triangles.hpp"
#include "stream/mesh/weld.hpp"
#include "stream/seams/null_charts.hpp"
#include "tests/stream/mesh/small_mesh.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {

/// Keeps all groups of all workers.
class GroupCollector : public GroupSinks, private GroupSink {
 public:
  GroupSink& of_worker(std::size_t) override { return *this; }
  std::vector<std::string> distributions() const override { return {}; }
  double cutoff(std::size_t) const override { return 0; }

  std::vector<Triangle> triangles;
  std::vector<RawEdge> raw_edges;
  std::vector<UvEdge> uv_edges;
  std::vector<SeamEdge> seam_edges;
  std::vector<VertexStar> stars;
  std::vector<Component> components;
  std::vector<Chart> charts;
  std::vector<CrackEdge> cracks;
  std::vector<TextureLevel> levels;

 private:
  void accept(std::span<const Triangle> groups) override { keep(groups, triangles); }
  void accept(std::span<const RawEdge> groups) override { keep(groups, raw_edges); }
  void accept(std::span<const UvEdge> groups) override { keep(groups, uv_edges); }
  void accept(std::span<const SeamEdge> groups) override { keep(groups, seam_edges); }
  void accept(std::span<const VertexStar> groups) override { keep(groups, stars); }
  void accept(std::span<const Component> groups) override { keep(groups, components); }
  void accept(std::span<const Chart> groups) override { keep(groups, charts); }
  void accept(std::span<const CrackEdge> groups) override { keep(groups, cracks); }
  void accept(std::span<const TextureLevel> groups) override { keep(groups, levels); }
  void sample(std::size_t, std::span<const Triangle>, std::vector<Sample>&) override {}
  void sample(std::size_t, std::span<const Chart>, std::vector<Sample>&) override {}
  void cut(std::size_t, const Sample&) override {}

  template <class Group>
  void keep(std::span<const Group> groups, std::vector<Group>& list) {
    const std::lock_guard lock(mutex_);
    list.insert(list.end(), groups.begin(), groups.end());
  }

  std::mutex mutex_;
};

/// A mesh on its way through the stages, as the pipeline sends it.
class Stages {
 public:
  Stages(TestEngine& engine, const SmallMesh& small, const TextureSlots& slots = one_image())
      : engine_(engine), mesh(small.store(engine)), weld(weld_vertices(engine, mesh)) {
    mesh.last_faces = LastUses(engine_.budget);
    note_last_faces(small.faces, 0, mesh.last_faces);
    frames = frame_slots(engine_, mesh, weld, slots);
    stream_triangles(slots);
  }

  /// The groups of edges; what they tell later stages is in `edges`.
  void run_edges() {
    const EdgeTable::Plan plan{.welded = weld.found_any(),
                               .faces = triangles.size(),
                               .vertices = mesh.positions.size(),
                               .memory_bytes = engine_.budget.free_bytes() / 4,
                               .keep_borders = true};
    LastUses of_welded;
    if (plan.welded) of_welded = last_faces_of_welded(engine_, mesh.last_faces, weld);
    const auto table =
        EdgeTable::make(engine_, plan, plan.welded ? of_welded : mesh.last_faces, frames, groups);
    add_all(*table);
    edges = table->finish();
  }

  std::uint64_t run_stars() {
    StarTable table(engine_,
                    {triangles.size(), mesh.positions.size(), engine_.budget.free_bytes() / 4},
                    mesh.last_faces, groups);
    add_all(table);
    return table.finish();
  }

  void run_components() {
    FaceLabels labels(engine_, std::move(edges.raw_links), faces.size(), edges.raw_manifold);
    group_components(engine_, labels, levels, groups);
  }

  std::uint64_t run_boundary(std::uint64_t boundary_vertices) {
    return count_boundary_components(engine_, std::move(edges.boundary_links),
                                     mesh.positions.size(), boundary_vertices);
  }

  Spill<FaceId> run_charts() {
    FaceLabels labels(engine_, std::move(edges.uv_links), faces.size(), edges.uv_manifold);
    ChartParts parts{labels, faces, areas_3d, std::move(edges.borders)};
    std::vector<std::unique_ptr<SampleStore>> no_samples;
    ChartResults results =
        group_charts(engine_, std::move(parts), frames, true, groups, no_samples);
    kept_charts = records_of(results.charts);
    chart_labels = std::move(labels.by_all_edges());
    std::sort(groups.charts.begin(), groups.charts.end(),
              [](const Chart& a, const Chart& b) { return raw(a.first_face) < raw(b.first_face); });
    return std::move(results.null_faces);
  }

  Spill<SeamCandidate> run_seams(Spill<FaceId> null_faces) {
    return drop_null_charts(engine_, std::move(edges.seams), std::move(null_faces), faces.size());
  }

 private:
  /// Face by face, each from another worker.
  template <class Table>
  void add_all(Table& table) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      table.add(i % engine_.workers.count(), {&triangles[i], 1});
      table.pass(i + 1);
    }
    table.settle();
  }

  TestEngine& engine_;

 public:
  MeshStore mesh;
  Weld weld;
  SlotFrames frames;
  std::vector<Triangle> triangles;  ///< in face order
  Spill<FaceLevels> levels;
  Spill<AtlasFace> faces;
  Spill<double> areas_3d;
  std::vector<Chart> kept_charts;
  Spill<Label> chart_labels;
  GroupCollector groups;
  EdgeResults edges;

 private:
  void stream_triangles(const TextureSlots& slots) {
    StageLog::Stage stage(engine_.log, "triangles");
    std::vector<std::vector<Triangle>> batches(engine_.workers.count());
    SpillWriter<FaceLevels> level_writer(engine_.scratch);
    SpillWriter<AtlasFace> face_writer(engine_.scratch);
    SpillWriter<double> area_writer(engine_.scratch);
    TriangleVisitor visitor;
    visitor.transform = [&](std::size_t worker, std::span<const Triangle> some) {
      batches[worker].insert(batches[worker].end(), some.begin(), some.end());
    };
    visitor.commit = [&](std::size_t worker) {
      for (const Triangle& triangle : batches[worker]) {
        triangles.push_back(triangle);
        level_writer.push(levels_of(triangle));
        face_writer.push(AtlasFace(triangle));
        area_writer.push(triangle.area_3d);
      }
      batches[worker].clear();
    };
    visit_triangles(engine_, mesh, weld, slots, frames, engine_.budget.free_bytes() / 2, stage,
                    visitor);
    levels = level_writer.finish();
    faces = face_writer.finish();
    areas_3d = area_writer.finish();
  }
};

}  // namespace atlasgauge
