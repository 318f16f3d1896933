#include "stream/mesh/components.hpp"

#include <utility>
#include <vector>

#include "stream/engine/keyed_groups.hpp"
#include "stream/engine/row_visit.hpp"

namespace atlasgauge {
namespace {

/// Consecutive faces of one component.
struct ComponentRun {
  std::uint32_t component;
  std::uint32_t faces;
  std::uint32_t conflict;
  std::uint32_t key() const { return component; }
};

Spill<Link> copy_of(const Engine& engine, Spill<Link>& links) {
  SpillWriter<Link> copy(engine.scratch);
  SpillReader<Link> reader(links);
  for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
    copy.append(block);
  }
  return copy.finish();
}

/// Labels and levels of the faces, side by side, as runs of each component.
KeyedGroups<ComponentRun>::Buckets distribute_runs(const Engine& engine, FaceLabels& labels,
                                                   Spill<FaceLevels>& levels) {
  const auto push_runs = [&](auto push) {
    const auto push_rows = [&](std::size_t worker, std::uint64_t, auto components, auto classes,
                               auto faces) {
      ComponentRun run{0, 0, 0};
      for (std::size_t i = 0; i < faces.size(); ++i) {
        if (faces[i] == FaceLevels::kNone) continue;
        if (run.faces > 0 && run.component != components[i].first()) {
          push(worker, std::exchange(run, {}));
        }
        run.component = components[i].first();
        ++run.faces;
        run.conflict |= classes[i].conflict() ? 1U : 0U;
      }
      if (run.faces > 0) push(worker, run);
    };
    visit_rows(engine, push_rows, labels.by_all_edges(), labels.by_manifold_edges(), levels);
  };
  return KeyedGroups<ComponentRun>::distribute(engine, levels.size(), levels.size(),
                                               "distributing components", push_runs);
}

void add(Component& component, const ComponentRun& run) {
  component.faces += run.faces;
  component.orientable = component.orientable && run.conflict == 0;
}

}  // namespace

FaceLabels::FaceLabels(const Engine& engine, Spill<Link> links, std::uint64_t faces, bool manifold)
    : manifold_(manifold) {
  if (!manifold) {
    by_all_edges_ = label_nodes(engine, copy_of(engine, links), faces, LinkRule::kAll);
  }
  by_manifold_edges_ = label_nodes(engine, std::move(links), faces, LinkRule::kManifoldOnly);
}

void group_components(const Engine& engine, FaceLabels& labels, Spill<FaceLevels>& levels,
                      GroupSinks& sinks) {
  std::vector<GroupBuffer<Component>> outputs;
  for (std::size_t i = 0; i < engine.workers.count(); ++i) {
    outputs.emplace_back(sinks.of_worker(i));
  }
  KeyedGroups<ComponentRun> groups(
      engine,
      [&](std::size_t worker, std::span<ComponentRun> runs) {
        Component component{0, true};
        for (const ComponentRun& run : runs) add(component, run);
        outputs[worker].push(component);
      },
      [&](std::uint32_t, Spill<ComponentRun> runs) {
        Component component{0, true};
        SpillReader<ComponentRun> reader(runs);
        ComponentRun run{};
        while (reader.read(run)) add(component, run);
        outputs[0].push(component);
      });
  groups.process(distribute_runs(engine, labels, levels));
  for (auto& output : outputs) output.flush();
}

std::uint64_t count_boundary_components(const Engine& engine, Spill<Link> boundary_links,
                                        std::uint64_t vertices, std::uint64_t boundary_vertices) {
  if (boundary_links.empty()) return 0;
  Spill<Label> labels = label_nodes(engine, std::move(boundary_links), vertices, LinkRule::kAll);
  return count_components(labels) - (vertices - boundary_vertices);
}

}  // namespace atlasgauge
