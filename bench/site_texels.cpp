#include "bench/site_texels.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

namespace atlasgauge {
namespace {

/// Texels [begin, end) of one row, all of one chart.
struct Run {
  std::int64_t begin, end;
  std::size_t chart;
};

using Runs = std::vector<Run>;  ///< of one row, ascending

struct Interval {
  std::int64_t begin, end;
};

using Intervals = std::vector<Interval>;  ///< ascending and apart

std::uint64_t length(const Intervals& intervals) {
  std::int64_t sum = 0;
  for (const Interval& interval : intervals) sum += interval.end - interval.begin;
  return static_cast<std::uint64_t>(sum);
}

Intervals united(Intervals intervals) {
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
  Intervals apart;
  for (const Interval& next : intervals) {
    if (apart.empty() || next.begin > apart.back().end) {
      apart.push_back(next);
    } else {
      apart.back().end = std::max(apart.back().end, next.end);
    }
  }
  return apart;
}

Intervals common(const Intervals& a, const Intervals& b) {
  Intervals both;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size(); a[i].end < b[j].end ? ++i : ++j) {
    const Interval part{std::max(a[i].begin, b[j].begin), std::min(a[i].end, b[j].end)};
    if (part.begin < part.end) both.push_back(part);
  }
  return both;
}

Interval clipped(std::int64_t begin, std::int64_t end, std::int64_t size) {
  return {std::max<std::int64_t>(begin, 0), std::min(end, size)};
}

Intervals covered(const Runs& runs) {
  Intervals intervals;
  for (const Run& run : runs) intervals.push_back({run.begin, run.end});
  return united(std::move(intervals));
}

/// Texels whose left and right neighbours are covered as well.
Intervals inner(const Runs& runs) {
  Intervals intervals;
  for (const Interval& interval : covered(runs)) {
    if (interval.end - interval.begin > 2) {
      intervals.push_back({interval.begin + 1, interval.end - 1});
    }
  }
  return intervals;
}

/// A row and those below and above it; beyond the texture they are empty.
using ThreeRows = std::array<const Runs*, 3>;

std::uint64_t count_bilinear(const ThreeRows& rows, std::int64_t size) {
  Intervals intervals;
  for (const Runs* row : rows) {
    for (const Run& run : *row) intervals.push_back(clipped(run.begin - 1, run.end + 1, size));
  }
  return length(united(std::move(intervals)));
}

std::uint64_t count_inner(const ThreeRows& rows) {
  return length(common(inner(*rows[0]), common(inner(*rows[1]), inner(*rows[2]))));
}

/// Texels of a run beside, above or below those of other runs.
std::uint64_t count_clashes(const Run& run, const ThreeRows& rows) {
  Intervals near;
  for (const Runs* row : rows) {
    auto other = std::lower_bound(row->begin(), row->end(), run.begin,
                                  [](const Run& a, std::int64_t begin) { return a.end < begin; });
    for (; other != row->end() && other->begin <= run.end; ++other) {
      if (other->chart != run.chart) near.push_back({other->begin - 1, other->end + 1});
    }
  }
  return length(common(united(std::move(near)), {{run.begin, run.end}}));
}

TexelCounts count_row(const ThreeRows& rows, std::int64_t size) {
  TexelCounts counts;
  counts.covered = length(covered(*rows[1]));
  counts.bilinear = count_bilinear(rows, size);
  counts.boundary = counts.covered - count_inner(rows);
  for (const Run& run : *rows[1]) counts.clashes += count_clashes(run, rows);
  return counts;
}

void add(const TexelCounts& row, std::uint64_t times, TexelCounts& sum) {
  sum.covered += times * row.covered;
  sum.bilinear += times * row.bilinear;
  sum.boundary += times * row.boundary;
  sum.clashes += times * row.clashes;
}

/// Rows [bottom, top) that hold the same runs.
struct Band {
  std::int64_t bottom, top;
  Runs runs;
};

/// Where bands begin and end, the texture's border included.
std::vector<std::int64_t> band_borders(const std::vector<TexelRect>& rects, std::int64_t size) {
  std::vector<std::int64_t> borders{0, size};
  for (const TexelRect& rect : rects) {
    borders.push_back(rect.bottom);
    borders.push_back(rect.top);
  }
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  return borders;
}

std::vector<Band> bands_of(const std::vector<TexelRect>& rects, std::int64_t size) {
  const std::vector<std::int64_t> borders = band_borders(rects, size);
  std::vector<Band> bands;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    bands.push_back({borders[i], borders[i + 1], {}});
  }
  for (std::size_t chart = 0; chart < rects.size(); ++chart) {
    const TexelRect& rect = rects[chart];
    if (rect.left >= rect.right) continue;
    const auto first = std::lower_bound(borders.begin(), borders.end(), rect.bottom);
    for (auto band = static_cast<std::size_t>(first - borders.begin());
         band < bands.size() && bands[band].top <= rect.top; ++band) {
      bands[band].runs.push_back({rect.left, rect.right, chart});
    }
  }
  for (Band& band : bands) {
    std::sort(band.runs.begin(), band.runs.end(),
              [](const Run& a, const Run& b) { return a.begin < b.begin; });
  }
  return bands;
}

}  // namespace

TexelCounts count_texels(const std::vector<TexelRect>& rects, std::int64_t size) {
  const std::vector<Band> bands = bands_of(rects, size);
  const Runs none;
  TexelCounts counts;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const Runs* const below = i == 0 ? &none : &bands[i - 1].runs;
    const Runs* const row = &bands[i].runs;
    const Runs* const above = i + 1 == bands.size() ? &none : &bands[i + 1].runs;
    const std::int64_t rows = bands[i].top - bands[i].bottom;
    if (rows == 1) {
      add(count_row({below, row, above}, size), 1, counts);
      continue;
    }
    add(count_row({below, row, row}, size), 1, counts);
    add(count_row({row, row, row}, size), static_cast<std::uint64_t>(rows) - 2, counts);
    add(count_row({row, row, above}, size), 1, counts);
  }
  return counts;
}

}  // namespace atlasgauge
