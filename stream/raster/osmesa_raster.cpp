#include "stream/raster/osmesa_raster.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/file/module.hpp"
#include "stream/raster/osmesa_module.hpp"
#include "stream/raster/scalar_raster.hpp"

namespace atlasgauge {
namespace {

constexpr Module kOsmesaModule{
    kOsmesaModuleFile, "draws with OSMesa",
    "install OSMesa (Debian: libosmesa6) or the program again, or use the scalar raster"};

/// Bounds the ranks and counts of a pass, which must be exact in floats, and its memory: 8 bytes
/// for each.
constexpr std::size_t kPassTriangles = std::size_t{1} << 20;
static_assert(kPassTriangles < OsmesaCanvas::kNoRank);

/// Triangles drawn before OSMesa is made to finish, as it keeps some 400 bytes for each until then.
/// More at once are no faster.
constexpr std::size_t kBatchTriangles = std::size_t{1} << 14;

/// Texels read back at once.
constexpr std::int64_t kBandTexels = std::int64_t{1} << 18;

OsmesaCanvasFunction load_module() {
  ::setenv("LP_NUM_THREADS", "0", 1);                // it works in the caller's
  ::setenv("GALLIUM_DRIVER", "llvmpipe", 1);         // whose way of rounding is known
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // or it would write to the user's home
  return reinterpret_cast<OsmesaCanvasFunction>(module_symbol(kOsmesaModule, kOsmesaCanvasSymbol));
}

TexelRect around(const TexelRect& a, const TexelRect& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

/// The viewport in the midst of which the window lies, in 1/256 texel of the level.
struct Viewport {
  explicit Viewport(const TexelRect& window)
      : x0(256 * (window.x0 - OsmesaCanvas::margin(window.width()))),
        y0(256 * (window.y0 - OsmesaCanvas::margin(window.height()))) {}

  bool holds(const SnappedTriangle& triangle) const {
    const auto inside = [](std::int64_t place) {
      return place >= 0 && place < 256 * OsmesaCanvas::kViewport;
    };
    for (int corner = 0; corner < 3; ++corner) {
      if (!inside(triangle.x[corner] - x0) || !inside(triangle.y[corner] - y0)) return false;
    }
    return true;
  }

  OsmesaCorner corner(const SnappedTriangle& triangle, int at, std::uint32_t rank) const {
    return {static_cast<std::uint32_t>(triangle.x[at] - x0),
            static_cast<std::uint32_t>(triangle.y[at] - y0), rank};
  }

  std::int64_t x0, y0;
};

/// Numbers the charts of a pass densely, in their order: a float holds a rank, but not every chart.
class ChartRanks {
 public:
  void clear() { charts_.clear(); }
  void add(std::uint32_t chart) {
    if (charts_.empty() || charts_.back() != chart) charts_.push_back(chart);
  }
  void finish() {
    std::sort(charts_.begin(), charts_.end());
    charts_.erase(std::unique(charts_.begin(), charts_.end()), charts_.end());
    last_ = 0;
  }

  /// Triangles of one chart often come one after the other.
  std::uint32_t rank(std::uint32_t chart) {
    if (charts_[last_] != chart) {
      last_ = static_cast<std::size_t>(std::lower_bound(charts_.begin(), charts_.end(), chart) -
                                       charts_.begin());
    }
    return static_cast<std::uint32_t>(last_);
  }
  std::uint32_t chart(std::size_t rank) const { return charts_[rank]; }

 private:
  std::vector<std::uint32_t> charts_;
  std::size_t last_ = 0;
};

class OsmesaRaster : public Raster {
 public:
  explicit OsmesaRaster(OsmesaCanvasFunction make_canvas) : canvas_(make_canvas()) {}

  void draw(std::span<const SnappedTriangle> triangles, TexelTile& tile) override {
    check_size(tile);
    while (!triangles.empty()) {
      const auto pass = triangles.first(std::min(kPassTriangles, triangles.size()));
      draw_pass(pass, tile);
      triangles = triangles.subspan(pass.size());
    }
    tally_.scalar = scalar_.tally().scalar;
  }

  /// A call clears, reads and merges all texels around its triangles.
  std::size_t batch_size() const override { return std::size_t{1} << 16; }

 private:
  static void check_size(const TexelTile& tile) {
    const TexelRect& rect = tile.rect();
    if (rect.width() <= kMaxOsmesaTile && rect.height() <= kMaxOsmesaTile) return;
    throw Error(ErrorKind::kInternal, "a tile of " + std::to_string(rect.width()) + "x" +
                                          std::to_string(rect.height()) +
                                          " texels is too large for OSMesa, which takes " +
                                          std::to_string(kMaxOsmesaTile) + " a side");
  }

  void draw_pass(std::span<const SnappedTriangle> triangles, TexelTile& tile) {
    const Viewport viewport(tile.window());
    const TexelRect dirty = choose(triangles, tile, viewport);
    if (chosen_.empty()) return;
    const TexelRect& window = tile.window();
    const TexelRect box{dirty.x0 - window.x0, dirty.y0 - window.y0, dirty.x1 - window.x0,
                        dirty.y1 - window.y0};
    canvas_->start(window.width(), window.height(), box);
    draw_chosen(triangles, viewport);
    merge(box, tile);
  }

  /// Notes the triangles for OSMesa and their charts, and draws those that it cannot. Returns the
  /// texels of the window that may be covered.
  TexelRect choose(std::span<const SnappedTriangle> triangles, TexelTile& tile,
                   const Viewport& viewport) {
    chosen_.clear();
    ranks_.clear();
    TexelRect dirty{};
    for (std::size_t at = 0; at < triangles.size(); ++at) {
      const SnappedTriangle& triangle = triangles[at];
      const TexelRect box = centres_in_box(triangle, tile.window());
      if (box.empty()) continue;
      if (!viewport.holds(triangle)) {
        scalar_.draw({&triangle, 1}, tile);
        continue;
      }
      dirty = chosen_.empty() ? box : around(dirty, box);
      chosen_.push_back(static_cast<std::uint32_t>(at));
      ranks_.add(triangle.chart);
    }
    ranks_.finish();
    return dirty;
  }

  void draw_chosen(std::span<const SnappedTriangle> triangles, const Viewport& viewport) {
    for (std::size_t from = 0; from < chosen_.size(); from += kBatchTriangles) {
      const std::size_t to = std::min(chosen_.size(), from + kBatchTriangles);
      corners_.clear();
      for (std::size_t at = from; at < to; ++at) add_corners(triangles[chosen_[at]], viewport);
      canvas_->draw(corners_);
    }
    tally_.osmesa += chosen_.size();
  }

  void add_corners(const SnappedTriangle& triangle, const Viewport& viewport) {
    const std::uint32_t rank = ranks_.rank(triangle.chart);
    for (int at = 0; at < 3; ++at) corners_.push_back(viewport.corner(triangle, at, rank));
  }

  /// Adds the pixels of `box` to the tile, a band of rows at a time.
  void merge(const TexelRect& box, TexelTile& tile) {
    const std::int64_t rows = std::max<std::int64_t>(1, kBandTexels / box.width());
    for (std::int64_t y = box.y0; y < box.y1; y += rows) {
      merge_band({box.x0, y, box.x1, std::min(box.y1, y + rows)}, tile);
    }
  }

  void merge_band(const TexelRect& band, TexelTile& tile) {
    read(OsmesaCanvas::Layer::kCount, band, counts_);
    read(OsmesaCanvas::Layer::kHighest, band, highest_);
    read(OsmesaCanvas::Layer::kLowest, band, lowest_);
    const TexelRect& window = tile.window();
    std::size_t pixel = 0;
    for (std::int64_t y = band.y0; y < band.y1; ++y) {
      const std::size_t row = tile.index(window.x0 + band.x0, window.y0 + y);
      for (std::size_t column = 0; column < static_cast<std::size_t>(band.width()); ++column) {
        merge_pixel(pixel++, row + column, tile);
      }
    }
  }

  void read(OsmesaCanvas::Layer layer, const TexelRect& band, std::vector<float>& to) {
    to.resize(static_cast<std::size_t>(band.width() * band.height()));
    canvas_->read(layer, band, to.data());
  }

  void merge_pixel(std::size_t pixel, std::size_t texel, TexelTile& tile) {
    if (counts_[pixel] == 0) return;
    const auto highest = static_cast<std::size_t>(highest_[pixel]);
    tile.cover(texel, static_cast<std::uint32_t>(counts_[pixel]), ranks_.chart(highest) + 1,
               highest_[pixel] != lowest_[pixel]);
  }

  std::unique_ptr<OsmesaCanvas> canvas_;
  ScalarRaster scalar_;
  std::vector<std::uint32_t> chosen_;  // positions in the pass
  ChartRanks ranks_;
  std::vector<OsmesaCorner> corners_;
  std::vector<float> counts_, highest_, lowest_;
};

}  // namespace

std::unique_ptr<Raster> make_osmesa_raster() {
  static const OsmesaCanvasFunction make_canvas = load_module();
  return std::make_unique<OsmesaRaster>(make_canvas);
}

}  // namespace atlasgauge
