#include "measures/output/chart_table.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace atlasgauge {
namespace {

const std::array<std::string, 16> kColumns{
    "chart",     "texture", "faces", "folds", "null",  "orientable", "area_3d", "area_uv",
    "perimeter", "u_min",   "v_min", "u_max", "v_max", "width",      "height",  "thinnest_side"};

std::uint64_t flag(bool value) {
  return value ? 1 : 0;
}

}  // namespace

ChartTable::ChartTable(const std::string& path) : file_(path, kColumns) {}

void ChartTable::add(const Chart& chart) {
  const UvBox& box = chart.uv_box;
  const auto if_boxed = [&](double value) { return box.empty ? TableValue() : TableValue(value); };
  const TableValue texture =
      chart.slot == kNone<SlotId> ? TableValue() : TableValue(std::uint64_t{raw(chart.slot)});
  const std::array<TableValue, kColumns.size()> row{std::uint64_t{raw(chart.first_face)},
                                                    texture,
                                                    chart.faces,
                                                    chart.folds,
                                                    flag(chart.null),
                                                    flag(chart.orientable),
                                                    chart.area_3d,
                                                    chart.area_uv,
                                                    chart.perimeter,
                                                    if_boxed(double{box.low_u}),
                                                    if_boxed(double{box.low_v}),
                                                    if_boxed(double{box.high_u}),
                                                    if_boxed(double{box.high_v}),
                                                    if_boxed(chart.width),
                                                    if_boxed(chart.height),
                                                    if_boxed(std::min(chart.width, chart.height))};
  file_.append(row);
}

}  // namespace atlasgauge
