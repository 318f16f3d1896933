#include "bench/worst/shape.hpp"

#include <cmath>
#include <numbers>

namespace atlasgauge {
namespace {

using nlohmann::json;

json quotient(double a, double b) {
  return b == 0 ? json() : json(a / b);
}

json counts(const Shape& shape) {
  return {{"fn", shape.faces},
          {"fndegen", shape.degenerate},
          {"faces_nonfinite", shape.nonfinite},
          {"faces_invalid", shape.invalid},
          {"fndup", shape.duplicates},
          {"fnzero", shape.zero_area},
          {"vn", shape.positions},
          {"vnunref", shape.unreferenced},
          {"vndup", shape.coincident},
          {"en", shape.edges},
          {"en_b", shape.boundary_edges},
          {"nonmanif_edge", shape.nonmanifold_edges},
          {"nonmanif_vert", shape.nonmanifold_vertices},
          {"connected_components", shape.components},
          {"largest_component_fn", shape.largest_component},
          {"boundary_components", shape.boundary_components},
          {"oriented", shape.oriented},
          {"orientable", shape.orientable},
          {"num_charts", shape.charts},
          {"num_null_charts", shape.null_charts},
          {"charts_nonorientable", shape.nonorientable_charts},
          {"en_uv", shape.uv_edges},
          {"en_uv_b", shape.uv_boundary_edges},
          {"seam_edges", shape.seam_edges},
          {"seam_edges_unsampled", shape.seam_edges},
          {"nfolds", shape.folds},
          {"faces_unmapped", shape.unmapped},
          {"faces_uv_outside", shape.outside},
          {"faces_untextured", 0},
          {"uv_far", 0},
          {"ntex", 1},
          {"textures", {"N/A"}}};
}

/// SPEC section 2: genus = -(V + F - E + L - 2C) / 2, truncated.
void add_topology(const Shape& shape, json& values) {
  const auto whole = [](std::uint64_t count) { return static_cast<std::int64_t>(count); };
  const std::int64_t vertices = whole(shape.positions - shape.unreferenced);
  const std::int64_t faces = whole(shape.faces - shape.degenerate - shape.nonfinite);
  const std::int64_t euler = vertices - whole(shape.edges) + faces;
  const std::int64_t loops = whole(shape.boundary_components);
  const bool manifold = shape.nonmanifold_edges == 0 && shape.nonmanifold_vertices == 0;
  values["euler"] = euler;
  values["boundary_loops"] = manifold ? loops : -1;
  values["genus"] = manifold ? -(euler + loops - 2 * whole(shape.components)) / 2 : -1;
}

void add_sizes(const Shape& shape, json& values) {
  const double side = shape.longest_side;
  if (shape.area) {
    values["area"] = *shape.area;
    values["area_normalized"] = quotient(*shape.area, side * side);
  }
  if (shape.boundary_len) {
    values["boundary_len"] = *shape.boundary_len;
    values["boundary_len_normalized"] = quotient(*shape.boundary_len, side);
  }
  if (shape.seam_len) values["seam_len"] = *shape.seam_len;
  if (shape.area_uv) values["area_uv"] = *shape.area_uv;
  if (!shape.boundary_len_uv) return;
  values["boundary_len_uv"] = *shape.boundary_len_uv;
  if (!shape.area_uv) return;
  const double disk = std::sqrt(4 * std::numbers::pi * *shape.area_uv);
  values["crumbliness"] = quotient(*shape.boundary_len_uv, disk);
  values["solidity"] = disk == 0 ? json() : quotient(disk, *shape.boundary_len_uv);
}

void add_uniform(const std::string& name, double value, json& values) {
  for (const char* statistic : {"_perc1", "_perc50", "_perc99", "_min", "_max", "_avg", "_rms"}) {
    values[name + statistic] = value;
  }
  values[name + "_var"] = 0.0;
}

bool is_half_integral(const json& value) {
  return value.is_number_float() && std::fmod(value.get<double>(), 0.5) == 0;
}

}  // namespace

Answers answers_of(const Shape& shape) {
  Answers answers{counts(shape), {}};
  add_topology(shape, answers.values);
  add_sizes(shape, answers.values);
  for (const auto& [name, value] : shape.uniform) add_uniform(name, value, answers.values);
  for (const char* key : {"area", "boundary_len", "area_uv", "boundary_len_uv", "seam_len"}) {
    if (answers.values.contains(key) && is_half_integral(answers.values[key])) {
      answers.exact_keys.emplace_back(key);
    }
  }
  return answers;
}

}  // namespace atlasgauge
