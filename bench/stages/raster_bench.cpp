// What the rasters cost a triangle, one thread each:
//
//     raster_bench [SIDE] [--benchmark_...]
//
// on a tile of SIDE x SIDE texels (2048), after checking that both draw the same.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "stream/raster/osmesa_raster.hpp"
#include "stream/raster/raster.hpp"
#include "stream/raster/scalar_raster.hpp"
#include "stream/raster/texel_tile.hpp"

namespace {

using namespace atlasgauge;

enum class Order { kMesh, kRandom };

struct UvTriangle {
  float u[3], v[3];
  std::uint32_t chart;
};

/// Quads of two triangles each over the whole texture, their vertices moved a little off the
/// lattice. Charts are squares of quads and follow each other, as in scans.
class Mesh {
 public:
  Mesh(std::int64_t side, double texels_per_triangle)
      : quads_(std::max(
            1, static_cast<int>(static_cast<double>(side) / std::sqrt(2 * texels_per_triangle)))),
        random_(1) {
    make_vertices();
    for (int y = 0; y < quads_; y += kChartQuads) {
      for (int x = 0; x < quads_; x += kChartQuads) add_chart(x, y);
    }
  }

  std::vector<UvTriangle> take(Order order) {
    if (order == Order::kRandom) std::shuffle(triangles_.begin(), triangles_.end(), random_);
    return std::move(triangles_);
  }

 private:
  static constexpr int kChartQuads = 32;
  struct Vertex {
    float u, v;
  };

  void make_vertices() {
    std::uniform_real_distribution<float> offset(-0.3F, 0.3F);
    const auto place = [&](int at) {
      const float moved = at == 0 || at == quads_ ? 0 : offset(random_);
      return (static_cast<float>(at) + moved) / static_cast<float>(quads_);
    };
    for (int y = 0; y <= quads_; ++y) {
      for (int x = 0; x <= quads_; ++x) {
        const float u = place(x);
        vertices_.push_back({u, place(y)});
      }
    }
  }

  void add_chart(int from_x, int from_y) {
    for (int y = from_y; y < std::min(quads_, from_y + kChartQuads); ++y) {
      for (int x = from_x; x < std::min(quads_, from_x + kChartQuads); ++x) {
        add({x, y}, {x + 1, y}, {x + 1, y + 1});
        add({x, y}, {x + 1, y + 1}, {x, y + 1});
      }
    }
    ++chart_;
  }

  struct Node {
    int x, y;
  };
  void add(Node a, Node b, Node c) {
    const auto vertex = [&](Node node) {
      return vertices_[static_cast<std::size_t>(node.y) * static_cast<std::size_t>(quads_ + 1) +
                       static_cast<std::size_t>(node.x)];
    };
    const Vertex p = vertex(a), q = vertex(b), r = vertex(c);
    triangles_.push_back({{p.u, q.u, r.u}, {p.v, q.v, r.v}, chart_});
  }

  int quads_;
  std::mt19937 random_;
  std::vector<Vertex> vertices_;
  std::vector<UvTriangle> triangles_;
  std::uint32_t chart_ = 0;
};

void snap_to(const LevelSize& level, std::span<const UvTriangle> from,
             std::vector<SnappedTriangle>& to) {
  const auto width = static_cast<double>(level.width), height = static_cast<double>(level.height);
  to.clear();
  for (const UvTriangle& triangle : from) {
    SnappedTriangle snapped;
    for (int k = 0; k < 3; ++k) {
      snapped.x[k] = snap(triangle.u[k] * width);
      snapped.y[k] = snap(triangle.v[k] * height);
    }
    snapped.chart = triangle.chart;
    to.push_back(snapped);
  }
}

TexelTile whole_level(std::int64_t side) {
  TexelTile tile;
  tile.reset({0, 0, side, side}, {side, side});
  return tile;
}

/// Counts and charts; the halo lies outside the level.
bool equal(const TexelTile& a, const TexelTile& b) {
  const std::size_t texels = a.stride() * static_cast<std::size_t>(a.rect().height() + 2);
  return std::equal(a.counts(), a.counts() + texels, b.counts()) &&
         std::equal(a.charts(), a.charts() + texels, b.charts());
}

using MakeRaster = std::function<std::unique_ptr<Raster>()>;

struct NamedRaster {
  std::string name;
  MakeRaster make;
};

const std::vector<NamedRaster>& rasters() {
  static const std::vector<NamedRaster> all{
      {"scalar", [] { return std::make_unique<ScalarRaster>(); }}, {"osmesa", make_osmesa_raster}};
  return all;
}

struct Scene {
  std::string name() const {
    return (order == Order::kMesh ? "mesh/" : "random/") + std::to_string(texels) + "_texels";
  }
  std::vector<SnappedTriangle> level_0(std::int64_t side) const {
    std::vector<SnappedTriangle> triangles;
    snap_to({side, side}, Mesh(side, texels).take(order), triangles);
    return triangles;
  }

  Order order;
  int texels;
};

const std::vector<Scene> kScenes{{Order::kMesh, 2},    {Order::kMesh, 10},  {Order::kMesh, 16},
                                 {Order::kMesh, 63},   {Order::kRandom, 2}, {Order::kRandom, 10},
                                 {Order::kRandom, 16}, {Order::kRandom, 63}};

bool rasters_agree(const Scene& scene, std::int64_t side) {
  const std::vector<SnappedTriangle> triangles = scene.level_0(side);
  TexelTile expected = whole_level(side);
  ScalarRaster().draw(triangles, expected);
  TexelTile drawn = whole_level(side);
  const std::unique_ptr<Raster> osmesa = make_osmesa_raster();
  osmesa->draw(triangles, drawn);
  if (equal(drawn, expected) && osmesa->tally().scalar == 0) return true;
  std::fprintf(stderr, "the rasters differ on %s\n", scene.name().c_str());
  return false;
}

void report_per_triangle(benchmark::State& state, std::size_t triangles) {
  state.counters["per_triangle"] = benchmark::Counter(
      static_cast<double>(triangles),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// The first run of each is not timed: OSMesa compiles its shaders then.

/// Level 0, snapped before.
void draw_level_0(benchmark::State& state, const Scene& scene, const MakeRaster& make,
                  std::int64_t side) {
  const std::vector<SnappedTriangle> triangles = scene.level_0(side);
  TexelTile tile = whole_level(side);
  const std::unique_ptr<Raster> raster = make();
  raster->draw(triangles, tile);
  for (auto _ : state) raster->draw(triangles, tile);
  report_per_triangle(state, triangles.size());
}

/// The first `levels` levels of a texture, or all, snapping included.
void draw_levels(benchmark::State& state, const MakeRaster& make, std::int64_t side,
                 std::size_t levels) {
  const std::vector<UvTriangle> triangles = Mesh(side, 10).take(Order::kMesh);
  std::vector<TexelTile> tiles;
  for (std::int64_t s = side; s > 0 && tiles.size() < levels; s /= 2)
    tiles.push_back(whole_level(s));
  const std::unique_ptr<Raster> raster = make();
  std::vector<SnappedTriangle> snapped;
  const auto draw_all = [&] {
    for (std::size_t from = 0; from < triangles.size(); from += raster->batch_size()) {
      const auto batch = std::span(triangles).subspan(
          from, std::min(raster->batch_size(), triangles.size() - from));
      for (TexelTile& tile : tiles) {
        snap_to({tile.rect().width(), tile.rect().height()}, batch, snapped);
        raster->draw(snapped, tile);
      }
    }
  };
  draw_all();
  for (auto _ : state) draw_all();
  report_per_triangle(state, triangles.size());
}

void register_all(std::int64_t side) {
  const auto add = [](const std::string& name, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
  };
  for (const Scene& scene : kScenes) {
    for (const NamedRaster& raster : rasters()) {
      add("draw/" + scene.name() + "/" + raster.name,
          [=](benchmark::State& state) { draw_level_0(state, scene, raster.make, side); });
    }
  }
  for (const NamedRaster& raster : rasters()) {
    for (const std::size_t levels : {1, 99}) {
      add("snap_and_draw/" + std::string(levels == 1 ? "level_0/" : "all_levels/") + raster.name,
          [=](benchmark::State& state) { draw_levels(state, raster.make, side, levels); });
    }
  }
}

int run(int argc, char** argv) {
  ::setenv("ATLASGAUGE_MODULE_DIR", ATLASGAUGE_OSMESA_DIR, 0);
  benchmark::Initialize(&argc, argv);
  const std::int64_t side = argc > 1 ? std::atoll(argv[1]) : 2048;
  if (side < 1 || side > kMaxOsmesaTile || argc > 2) {
    std::fprintf(stderr, "usage: raster_bench [SIDE] [--benchmark_...], SIDE from 1 to %d\n",
                 static_cast<int>(kMaxOsmesaTile));
    return 2;
  }
  for (const Scene& scene : kScenes) {
    if (!rasters_agree(scene, side)) return 1;
  }
  register_all(side);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
