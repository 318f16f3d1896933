#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "stream/engine/pair_sum.hpp"
#include "stream/mesh/chart_part.hpp"

namespace atlasgauge {

/// Joins the faces of a chart to a few parts, which is exact: a run of faces ends where its sums
/// would be rounded. Runs of a few charts are open at a time, because faces along a border take
/// turns.
class ChartRuns {
 public:
  /// Takes a part of one face; calls push(part) for what this ends.
  template <class Push>
  void add(const ChartPart& face, Push push) {
    Run& run = runs_[place_of(face)];
    if (run.join(face)) return;
    run.end(push);
    run = Run(face);
  }

  template <class Push>
  void end_all(Push push) {
    for (Run& run : runs_) std::exchange(run, Run()).end(push);
  }

 private:
  class Run {
   public:
    Run() = default;
    explicit Run(const ChartPart& face)
        : part_(face), area_uv_(face.area_uv), area_3d_(face.area_3d_or_length) {}

    bool join(const ChartPart& face) {
      if (!continues_with(face)) return false;
      PairSum area_uv = area_uv_, area_3d = area_3d_;
      if (!area_uv.add(face.area_uv) || !area_3d.add(face.area_3d_or_length)) return false;
      area_uv_ = area_uv;
      area_3d_ = area_3d;
      ++part_.faces;
      part_.low_u = std::min(part_.low_u, face.low_u);
      part_.low_v = std::min(part_.low_v, face.low_v);
      part_.high_u = std::max(part_.high_u, face.high_u);
      part_.high_v = std::max(part_.high_v, face.high_v);
      return true;
    }

    template <class Push>
    void end(Push push) {
      if (part_.faces == 0) return;
      push_areas(area_uv_.high(), area_3d_.high(), push);
      if (area_uv_.low() == 0 && area_3d_.low() == 0) return;
      part_.faces = 0;
      push_areas(area_uv_.low(), area_3d_.low(), push);
    }

   private:
    bool continues_with(const ChartPart& face) const {
      return part_.faces > 0 && part_.is_like(face) &&
             (!part_.has_no_area() || part_.first_face() + part_.faces == face.first_face());
    }

    template <class Push>
    void push_areas(double area_uv, double area_3d, Push push) {
      part_.area_uv = area_uv;
      part_.area_3d_or_length = area_3d;
      push(part_);
    }

    ChartPart part_{};
    PairSum area_uv_, area_3d_;
  };

  /// A power of two; all within a cache of the first level.
  static constexpr unsigned kPlaceBits = 7;

  /// Faces of one chart that are not alike have places of their own.
  static std::size_t place_of(const ChartPart& part) {
    const std::uint32_t kind = (part.first_face_and_flags >> 30) ^ (part.slot_and_flags >> 28 << 2);
    return (part.chart * 64U + kind) * 0x9E3779B1U >> (32 - kPlaceBits);
  }

  std::array<Run, std::size_t{1} << kPlaceBits> runs_{};
};

}  // namespace atlasgauge
