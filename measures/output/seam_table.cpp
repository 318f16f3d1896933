#include "measures/output/seam_table.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include "measures/base/float_digits.hpp"

namespace atlasgauge {
namespace {

std::vector<std::string> columns(bool texmetro) {
  std::vector<std::string> names{
      "x0",        "y0",   "z0",   "x1",   "y1",   "z1",      "length_3d",  //
      "texture_a", "u0_a", "v0_a", "u1_a", "v1_a",                          //
      "texture_b", "u0_b", "v0_b", "u1_b", "v1_b", "samples", "discrepancy"};
  if (texmetro) names.emplace_back("texmetro_discrepancy");
  return names;
}

using Row = std::vector<TableValue>;

void append_side(Row& row, const SeamSide& side) {
  row.push_back(side.slot == kNone<SlotId> ? TableValue()
                                           : TableValue(std::uint64_t{raw(side.slot)}));
  for (const TexCoord& t : side.t) {
    row.insert(row.end(), {double_of_digits(t.u), double_of_digits(t.v)});
  }
}

}  // namespace

SeamTable::SeamTable(const std::string& path, bool texmetro)
    : texmetro_(texmetro), file_(path, columns(texmetro)) {}

void SeamTable::write(SeamRows& rows) {
  for (LocatedSeam seam; rows.read(seam);) add(seam);
}

void SeamTable::add(const LocatedSeam& seam) {
  const SeamEdge& edge = seam.edge;
  Row row;
  for (const Position& p : seam.p) row.insert(row.end(), {p.x, p.y, p.z});
  row.emplace_back(edge.length_3d);
  for (const SeamSide& side : edge.sides) append_side(row, side);
  row.push_back(edge.sampled ? TableValue(edge.samples) : TableValue());
  row.emplace_back(edge.discrepancy);
  if (texmetro_) row.emplace_back(edge.texmetro_discrepancy);
  file_.append(row);
}

}  // namespace atlasgauge
