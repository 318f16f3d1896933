#include "tests/support/oracle/seams.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include "tests/support/oracle/colours.hpp"
#include "tests/support/oracle/geometry.hpp"

namespace atlasgauge::oracle {
namespace {

std::set<int64_t> charts_with_area(const Analysis& analysis) {
  std::set<int64_t> charts;
  for (const FaceFacts& face : analysis.faces) {
    if (face.signed_uv_area != 0) charts.insert(face.chart);
  }
  return charts;
}

const FaceFacts& facts_of(const Analysis& analysis, const EdgeUse& use) {
  return analysis.faces[static_cast<size_t>(use.face)];
}

bool is_seam(const Analysis& analysis, const std::vector<EdgeUse>& uses,
             const std::set<int64_t>& charts) {
  if (uses.size() != 2) return false;
  std::array<EdgeKey, 2> uv_keys;
  for (size_t i = 0; i < 2; ++i) {
    const FaceFacts& face = facts_of(analysis, uses[i]);
    if (!charts.contains(face.chart)) return false;
    uv_keys[i] = edge_key(face.uv_vertices, uses[i].corner);
  }
  return uv_keys[0] != uv_keys[1];
}

SeamSide side_of(const Analysis& analysis, const EdgeUse& use) {
  const Face& face = analysis.model.faces[static_cast<size_t>(use.face)];
  const auto k = static_cast<size_t>(use.corner);
  std::array<size_t, 2> corners = {k, (k + 1) % 3};
  if (!use.forward) std::swap(corners[0], corners[1]);
  SeamSide side{use, face.slot, {}, {}};
  for (size_t end = 0; end < 2; ++end) {
    side.uvs[end] = face.uvs[corners[end]];
    side.texels[end] = facts_of(analysis, use).texels[corners[end]];
  }
  return side;
}

// v in the upper half.
uint64_t bits_of(const Uv& uv) {
  const auto bits = [](float x) { return uint64_t{std::bit_cast<uint32_t>(x + 0.0F)}; };
  return bits(uv[1]) << 32 | bits(uv[0]);
}

bool comes_before(const SeamSide& a, const SeamSide& b) {
  const auto key = [](const SeamSide& side) {
    std::array<std::optional<uint64_t>, 2> bits;
    for (size_t end = 0; end < 2; ++end) {
      if (side.uvs[end]) bits[end] = bits_of(*side.uvs[end]);
    }
    return std::tuple(side.slot, bits);
  };
  return key(a) < key(b);
}

const Slot& slot_of(const Analysis& analysis, const SeamSide& side) {
  return analysis.model.slots[static_cast<size_t>(*side.slot)];
}

bool can_be_sampled(const Analysis& analysis, const SeamSide& side) {
  const FaceFacts& face = facts_of(analysis, side.use);
  return face.has_uv_triangle && !face.uv_far && slot_of(analysis, side).pixels;
}

double longer_side(const Seam& seam) {
  double longest = 0;
  for (const SeamSide& side : seam.sides) {
    longest = std::max(longest, texel_distance(side.texels[0], side.texels[1]));
  }
  return longest;
}

Texel point_at(const std::array<Texel, 2>& ends, double t) {
  return {ends[0][0] + (ends[1][0] - ends[0][0]) * t, ends[0][1] + (ends[1][1] - ends[0][1]) * t};
}

std::optional<double> mean_distance(const Analysis& analysis, const Seam& seam,
                                    const std::array<std::array<Texel, 2>, 2>& ends,
                                    int64_t samples,
                                    const std::function<double(int64_t)>& sample_at) {
  if (samples == 0) return std::nullopt;
  double sum = 0;
  for (int64_t i = 0; i < samples; ++i) {
    std::array<Colour, 2> colours;
    for (size_t side = 0; side < 2; ++side) {
      colours[side] =
          bilinear(slot_of(analysis, seam.sides[side]), point_at(ends[side], sample_at(i)));
    }
    sum += colour_distance(colours[0], colours[1]);
  }
  return sum / static_cast<double>(samples);
}

int64_t five_a_texel(double length) {
  return 5 * static_cast<int64_t>(std::max(0.0, std::ceil(length)));
}

void sample(const Analysis& analysis, Seam& seam) {
  constexpr double kMillionth = 1e-6;
  seam.samples = five_a_texel(longer_side(seam) - kMillionth);
  const auto count = static_cast<double>(seam.samples);
  seam.discrepancy =
      mean_distance(analysis, seam, {seam.sides[0].texels, seam.sides[1].texels}, seam.samples,
                    [&](int64_t i) { return (static_cast<double>(i) + 0.5) / count; });
}

// Each side in the direction of its own face, from the very beginning on.
void sample_as_texmetro(const Analysis& analysis, Seam& seam) {
  std::array<std::array<Texel, 2>, 2> ends;
  for (size_t i = 0; i < 2; ++i) {
    ends[i] = seam.sides[i].texels;
    if (!seam.sides[i].use.forward) std::swap(ends[i][0], ends[i][1]);
  }
  const int64_t samples = five_a_texel(longer_side(seam));
  seam.texmetro_discrepancy = mean_distance(analysis, seam, ends, samples, [&](int64_t i) {
    return static_cast<double>(i) / static_cast<double>(samples);
  });
}

Seam find_sides(const Analysis& analysis, const EdgeKey& vertices,
                const std::vector<EdgeUse>& uses) {
  Seam seam;
  seam.vertices = vertices;
  seam.length_3d = edge_length(analysis.model, vertices);
  seam.sides = {side_of(analysis, uses[0]), side_of(analysis, uses[1])};
  if (comes_before(seam.sides[1], seam.sides[0])) std::swap(seam.sides[0], seam.sides[1]);
  seam.sampled = can_be_sampled(analysis, seam.sides[0]) && can_be_sampled(analysis, seam.sides[1]);
  return seam;
}

}  // namespace

std::vector<Seam> find_seams(const Analysis& analysis, bool texmetro) {
  const std::set<int64_t> charts = charts_with_area(analysis);
  std::vector<Seam> seams;
  for (const auto& [vertices, uses] : analysis.welded_edges) {
    if (is_seam(analysis, uses, charts)) seams.push_back(find_sides(analysis, vertices, uses));
  }
  for (Seam& seam : seams) {
    if (!seam.sampled) continue;
    sample(analysis, seam);
    if (texmetro) sample_as_texmetro(analysis, seam);
  }
  return seams;
}

}  // namespace atlasgauge::oracle
