#pragma once

#include <array>

#include "tests/support/oracle/levels.hpp"

// The formulas of the specification for single faces and edges, each operation rounded for itself.
namespace atlasgauge::oracle {

bool is_finite(const Position& position);

// Adding +0 turns -0 into +0 and leaves all else as it is.
Position without_negative_zero(const Position& p);

Position minus(const Position& p, const Position& q);
Position cross(const Position& a, const Position& b);
double dot(const Position& a, const Position& b);
double length(const Position& a);

std::array<Position, 3> corner_positions(const Model& model, const Triple& vertices);
double triangle_area(const std::array<Position, 3>& p);
double edge_length(const Model& model, const EdgeKey& edge);

double texel_distance(const Texel& a, const Texel& b);
double signed_texel_area(const std::array<Texel, 3>& t);

}  // namespace atlasgauge::oracle
