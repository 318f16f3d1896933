#include "stream/seams/seam_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "tests/stream/mesh/stages.hpp"
#include "tests/stream/seams/memory_textures.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

using Rgb = std::array<double, 3>;

/// Textures whose seams are sampled.
class Scene {
 public:
  SlotId add(const MemoryImage& image) { return textures_.add(image); }

  /// Both sides run from the edge's first vertex to its second; UVs.
  void seam(SlotId a, TexCoord a_from, TexCoord a_to, SlotId b, TexCoord b_from, TexCoord b_to) {
    SeamCandidate edge{};
    edge.v[0] = VertexId{static_cast<std::uint32_t>(edges.size())};
    edge.v[1] = VertexId{static_cast<std::uint32_t>(edges.size() + 1)};
    edge.sides[0] = {a, {a_from, a_to}};
    edge.sides[1] = {b, {b_from, b_to}};
    edge.length_3d = 1 + static_cast<double>(edges.size() % 7);
    edge.sampled = true;
    edge.runs_down[1] = true;
    edges.push_back(edge);
  }

  /// The edges, measured, in the order in which they were added.
  std::vector<SeamEdge> measure(const EngineOptions& options = {}) {
    TestEngine engine(options);
    GroupCollector groups;
    SeamPlan wanted = plan;
    wanted.decode.model = "model.obj";
    std::mutex mutex;
    wanted.decode.open_image = [&](const ImageSource& image) {
      {
        const std::lock_guard lock(mutex);
        ++opened[image.path];
      }
      return textures_.open()(image);
    };
    Warnings warnings([&](const std::string& text) { warned.push_back(text); });
    results = sample_seams(engine, spill_of(engine, edges), textures_.slots(),
                           SlotFrames(textures_.frames()), wanted, warnings, groups);
    texture_seams = records_of(results.textures);
    results.textures.clear();
    results.edges.clear();
    std::sort(groups.seam_edges.begin(), groups.seam_edges.end(),
              [](const SeamEdge& a, const SeamEdge& b) { return raw(a.v[0]) < raw(b.v[0]); });
    peak_scratch_bytes = engine.scratch.peak_bytes();
    return groups.seam_edges;
  }

  /// Whether the check before the work finds room for it.
  bool has_room(const EngineOptions& options) const {
    TestEngine engine(options);
    try {
      require_room_for_seams(engine, textures_.slots(), plan.decode);
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  const MemoryTextures& textures() const { return textures_; }

  SeamPlan plan;
  std::vector<SeamCandidate> edges;
  std::vector<std::string> warned;
  std::map<std::string, int> opened;
  SeamResults results;
  std::vector<TextureSeams> texture_seams;
  std::uint64_t peak_scratch_bytes = 0;

 private:
  MemoryTextures textures_;
};

MemoryImage grey(std::uint32_t width, std::uint32_t height,
                 std::function<double(std::uint32_t, std::uint32_t)> level) {
  return {{.size = {width, height}},
          [level](std::uint32_t column, std::uint32_t row, int) { return level(column, row); }};
}

MemoryImage constant(double level, std::uint32_t width = 8, std::uint32_t height = 8) {
  return grey(width, height, [level](std::uint32_t, std::uint32_t) { return level; });
}

double from_grey(double difference) {
  return difference * std::sqrt(3.0);
}

TEST(SeamSamplingTest, StepOfKnownHeightIsThatHeight) {
  Scene scene;
  const SlotId low = scene.add(constant(40)), high = scene.add(constant(47));
  scene.seam(low, {0.1F, 0.1F}, {0.7F, 0.2F}, high, {0.9F, 0.4F}, {0.2F, 0.8F});
  const std::vector<SeamEdge> edges = scene.measure();
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_TRUE(edges[0].sampled);
  EXPECT_DOUBLE_EQ(edges[0].discrepancy, from_grey(7));
}

TEST(SeamSamplingTest, FiveSamplesATexelOfTheLongerSide) {
  Scene scene;
  const SlotId slot = scene.add(constant(1, 16, 16));
  scene.seam(slot, {0, 0}, {0.125F, 0}, slot, {0, 0.5F}, {0, 1});                // 2 and 8 texels
  scene.seam(slot, {0, 0}, {0.1875F, 0.25F}, slot, {0.5F, 0.5F}, {0.5F, 0.5F});  // 5 and 0
  scene.seam(slot, {0, 0}, {0.07F, 0}, slot, {0, 0}, {0, 0.001F});               // 1.12
  scene.seam(slot, {0.5F, 0.5F}, {0.5F, 0.5F}, slot, {0.25F, 0}, {0.25F, 0});    // none
  const std::vector<SeamEdge> edges = scene.measure();
  EXPECT_EQ(edges[0].samples, 40U);
  EXPECT_EQ(edges[1].samples, 25U);
  EXPECT_EQ(edges[2].samples, 10U);
  EXPECT_EQ(edges[3].samples, 0U);
  EXPECT_TRUE(edges[3].sampled);
  EXPECT_TRUE(std::isnan(edges[3].discrepancy));
}

TEST(SeamSamplingTest, SidesCorrespondAlongTheEdge) {
  // The level is 10 times the column, so 10 (x - 1/2) between the outermost texel centres.
  Scene scene;
  const SlotId slot =
      scene.add(grey(16, 16, [](std::uint32_t column, std::uint32_t) { return 10 * column; }));
  const auto u = [](int texels) { return static_cast<float>(texels) / 16; };
  scene.seam(slot, {u(2), 0.5F}, {u(6), 0.5F}, slot, {u(2), 0.25F}, {u(6), 0.25F});
  scene.seam(slot, {u(2), 0.5F}, {u(6), 0.5F}, slot, {u(6), 0.25F}, {u(2), 0.25F});
  const std::vector<SeamEdge> edges = scene.measure();
  EXPECT_EQ(edges[0].discrepancy, 0);
  // |x - (8 - x)| = 2 |x - 4| at 20 midpoints of [2, 6]: its mean over ten midpoints of [0, 2] is
  // 2, whatever their number.
  EXPECT_NEAR(edges[1].discrepancy, from_grey(20), 1e-12);
}

TEST(SeamSamplingTest, VIsUp) {
  Scene scene;
  const SlotId slot =
      scene.add(grey(4, 8, [](std::uint32_t, std::uint32_t row) { return row < 4 ? 200 : 100; }));
  const SlotId zero = scene.add(constant(0));
  scene.seam(slot, {0.3F, 0.9F}, {0.6F, 0.7F}, zero, {0, 0}, {0, 0});
  scene.seam(slot, {0.3F, 0.3F}, {0.6F, 0.1F}, zero, {0, 0}, {0, 0});
  const std::vector<SeamEdge> edges = scene.measure();
  EXPECT_DOUBLE_EQ(edges[0].discrepancy, from_grey(200));
  EXPECT_DOUBLE_EQ(edges[1].discrepancy, from_grey(100));
}

TEST(SeamSamplingTest, TexelsRepeatBeyondTheBorderAnyNumberOfTimes) {
  Scene scene;
  const SlotId slot = scene.add(
      grey(8, 8, [](std::uint32_t column, std::uint32_t row) { return 20 * column + 3 * row; }));
  scene.seam(slot, {-0.25F, 0.5F}, {0.25F, 0.75F}, slot, {1000.75F, -6.5F}, {1001.25F, -6.25F});
  EXPECT_NEAR(scene.measure()[0].discrepancy, 0, 1e-9);
}

TEST(SeamSamplingTest, BorderTexelsBlendWithThoseOfTheOtherBorder) {
  Scene scene;
  const SlotId slot = scene.add(
      grey(4, 4, [](std::uint32_t column, std::uint32_t) { return column == 0 ? 80 : 0; }));
  const SlotId zero = scene.add(constant(0));
  scene.seam(slot, {1, 0.1F}, {1, 0.9F}, zero, {0, 0}, {0, 0});
  EXPECT_DOUBLE_EQ(scene.measure()[0].discrepancy, from_grey(40));
}

TEST(SeamSamplingTest, WiderFormatsScaleTo255) {
  Scene scene;
  MemoryImage wide{
      {.size = {70, 3}, .kind = TexelKind::kShort},
      [](std::uint32_t, std::uint32_t, int channel) { return channel == 0 ? 65535 : 257; }};
  MemoryImage real{{.size = {5, 70}, .kind = TexelKind::kFloat},
                   [](std::uint32_t, std::uint32_t, int channel) { return channel == 0 ? 2 : 0; }};
  const SlotId a = scene.add(wide), b = scene.add(real);
  scene.seam(a, {0, 0}, {1, 1}, b, {0, 0}, {1, 1});
  EXPECT_NEAR(scene.measure()[0].discrepancy, std::sqrt(255.0 * 255 + 1 + 1), 1e-11);
}

TEST(SeamSamplingTest, UndecodableImageLeavesItsSeamsUnsampledAndTheOthersMeasured) {
  Scene scene;
  MemoryImage cut = constant(9, 100, 100);
  cut.good_rows = 80;
  const SlotId bad = scene.add(cut), low = scene.add(constant(1)), high = scene.add(constant(4));
  scene.seam(low, {0, 0}, {1, 0}, bad, {0, 0}, {1, 0});
  scene.seam(low, {0, 0}, {1, 0}, high, {0, 0}, {1, 0});
  const std::vector<SeamEdge> edges = scene.measure();
  EXPECT_FALSE(edges[0].sampled);
  EXPECT_EQ(edges[0].samples, 0U);
  EXPECT_DOUBLE_EQ(edges[1].discrepancy, from_grey(3));
  ASSERT_EQ(scene.warned.size(), 1U);
  EXPECT_EQ(scene.warned[0], "model.obj: image0: it is cut short; its seams are not sampled");
}

TEST(SeamSamplingTest, TexelsThatAreNotNumbersLeaveTheirSeamsUnsampled) {
  Scene scene;
  MemoryImage holes{{.size = {4, 4}, .kind = TexelKind::kFloat},
                    [](std::uint32_t column, std::uint32_t, int) { return column == 0 ? NAN : 1; }};
  const SlotId slot = scene.add(holes);
  scene.seam(slot, {0, 0}, {0.25F, 0}, slot, {0.5F, 0.5F}, {0.75F, 0.5F});
  scene.seam(slot, {0.5F, 0}, {0.75F, 0}, slot, {0.5F, 0.5F}, {0.75F, 0.5F});
  const std::vector<SeamEdge> edges = scene.measure();
  EXPECT_FALSE(edges[0].sampled);
  EXPECT_EQ(edges[1].discrepancy, 0);
  EXPECT_EQ(scene.warned.size(), 1U);
}

TEST(SeamSamplingTest, ImagesWithoutSeamsAreNotOpenedAndOthersOnce) {
  Scene scene;
  const SlotId a = scene.add(constant(1, 200, 200)), b = scene.add(constant(2, 200, 200));
  scene.add(constant(3));
  for (int i = 0; i < 50; ++i) scene.seam(a, {0, 0}, {1, 1}, b, {1, 0}, {0, 1});
  scene.measure();
  EXPECT_EQ(scene.opened, (std::map<std::string, int>{{"image0", 1}, {"image1", 1}}));
  EXPECT_EQ(scene.results.work.images_decoded, 2U);
  EXPECT_EQ(scene.results.work.texels_decoded, 80000U);
}

TEST(SeamSamplingTest, WhatIsNotRefusedBeforeTheWorkFindsItsMemory) {
  constexpr std::uint64_t kMiB = 1 << 20;
  for (const std::size_t workers : {1, 4}) {
    int passed = 0, refused = 0;
    for (std::uint64_t decoder_bytes = 3 * kMiB; decoder_bytes < 4 * kMiB;
         decoder_bytes += 10'000) {
      Scene scene;
      MemoryImage image = constant(1, 100, 100);
      image.header.decoder_bytes = decoder_bytes;
      const SlotId slot = scene.add(image);
      scene.seam(slot, {0, 0}, {1, 0}, slot, {0, 0.5F}, {1, 0.5F});
      const EngineOptions options{.budget_bytes = 4 * kMiB, .workers = workers};
      const bool has_room = scene.has_room(options);
      ++(has_room ? passed : refused);
      if (has_room) {
        EXPECT_NO_THROW(scene.measure(options)) << decoder_bytes;
      }
    }
    EXPECT_GT(passed, 0);
    EXPECT_GT(refused, 0);
  }
}

TEST(SeamSamplingTest, TexMetroComparesOppositeEnds) {
  Scene scene;
  scene.plan.texmetro = true;
  const SlotId slot =
      scene.add(grey(16, 16, [](std::uint32_t column, std::uint32_t) { return 10 * column; }));
  const auto u = [](int texels) { return static_cast<float>(texels) / 16; };
  scene.seam(slot, {u(2), 0.5F}, {u(6), 0.5F}, slot, {u(2), 0.25F}, {u(6), 0.25F});
  const std::vector<SeamEdge> edges = scene.measure();
  EXPECT_EQ(edges[0].discrepancy, 0);
  // |(2 + 4 t) - (6 - 4 t)| = |8 t - 4| at t = i / 20: 4 (1 + 2 (0.9 + 0.8 + ... + 0.1)) / 20 = 2.
  EXPECT_NEAR(edges[0].texmetro_discrepancy, from_grey(20), 1e-12);
}

TEST(SeamSamplingTest, MeansOfTexturesAreWeightedByLengthAndCountAnEdgeOnce) {
  Scene scene;
  const SlotId a = scene.add(constant(0)), b = scene.add(constant(10)), c = scene.add(constant(50));
  scene.seam(a, {0, 0}, {1, 0}, a, {0, 0.5F}, {1, 0.5F});  // length 1, nothing
  scene.seam(a, {0, 0}, {1, 0}, b, {0, 0}, {1, 0});        // length 2, step 10
  scene.seam(b, {0, 0}, {1, 0}, c, {0, 0}, {1, 0});        // length 3, step 40
  scene.measure();
  ASSERT_EQ(scene.texture_seams.size(), 3U);
  EXPECT_EQ(scene.texture_seams[0].edges, 2U);
  EXPECT_DOUBLE_EQ(scene.texture_seams[0].discrepancy, from_grey(20.0 / 3));
  EXPECT_DOUBLE_EQ(scene.texture_seams[1].discrepancy, from_grey((2 * 10 + 3 * 40) / 5.0));
  EXPECT_DOUBLE_EQ(scene.texture_seams[2].discrepancy, from_grey(40));
}

/// SPEC section 5, read as it is written.
class NaiveSampler {
 public:
  explicit NaiveSampler(const Scene& scene) : scene_(scene) {}

  double discrepancy(const SeamCandidate& edge) const {
    const auto [a0, a1] = segment(edge.sides[0]);
    const auto [b0, b1] = segment(edge.sides[1]);
    const double longer = std::max(distance(a0, a1), distance(b0, b1));
    const auto n = static_cast<int>(5 * std::ceil(longer - 1e-6));
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) / n;
      const Rgb a = colour(edge.sides[0].slot, at(a0, a1, t));
      const Rgb b = colour(edge.sides[1].slot, at(b0, b1, t));
      sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
    return sum / n;
  }

 private:
  std::pair<Texel, Texel> segment(const SeamSide& side) const {
    const SlotFrame& frame = scene_.textures().frames()[raw(side.slot)];
    return {frame.texel(side.t[0]), frame.texel(side.t[1])};
  }
  static Texel at(const Texel& a, const Texel& b, double t) {
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
  }
  Rgb colour(SlotId slot, const Texel& p) const {
    const double x = std::floor(p.x - 0.5), y = std::floor(p.y - 0.5);
    const double fx = p.x - 0.5 - x, fy = p.y - 0.5 - y;
    Rgb sum{};
    for (int c = 0; c < 4; ++c) {
      const double weight = (c % 2 == 1 ? fx : 1 - fx) * (c / 2 == 1 ? fy : 1 - fy);
      for (int k = 0; k < 3; ++k) sum[k] += weight * texel(slot, x + c % 2, y + c / 2, k);
    }
    return sum;
  }
  double texel(SlotId slot, double x, double y, int channel) const {
    const MemoryImage& image = scene_.textures().image(slot);
    const double w = image.header.size.width, h = image.header.size.height;
    const double column = x - std::floor(x / w) * w, from_bottom = y - std::floor(y / h) * h;
    const double scale = image.header.kind == TexelKind::kByte    ? 1
                         : image.header.kind == TexelKind::kShort ? 255.0 / 65535
                                                                  : 255;
    return scale * image.component(static_cast<std::uint32_t>(column),
                                   static_cast<std::uint32_t>(h - 1 - from_bottom), channel);
  }

  const Scene& scene_;
};

/// Images of all kinds and of many sizes, seams anywhere.
Scene random_scene(std::uint32_t seed, int seams) {
  std::mt19937 random(seed);
  const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
  Scene scene;
  for (const ImageSize size : {ImageSize{1, 1}, ImageSize{64, 64}, ImageSize{65, 63},
                               ImageSize{2, 200}, ImageSize{300, 129}, ImageSize{128, 1}}) {
    const auto kind = static_cast<TexelKind>(below(3));
    const double most = kind == TexelKind::kByte ? 256 : kind == TexelKind::kShort ? 65536 : 1;
    const std::uint32_t salt = below(1U << 31);
    scene.add(
        {{.size = size, .kind = kind}, [=](std::uint32_t column, std::uint32_t row, int channel) {
           const std::uint32_t hash =
               (column * 73856093U) ^ (row * 19349663U) ^ (channel * 83492791U) ^ salt;
           const double part = (hash * 2654435761U >> 16) / 65536.0;
           return kind == TexelKind::kFloat ? static_cast<double>(static_cast<float>(part))
                                            : std::floor(part * most);
         }});
  }
  std::uniform_real_distribution<float> place(-2, 3), step(-0.2F, 0.2F);
  std::uniform_int_distribution<int> lattice(-4, 8);
  const auto point = [&]() -> TexCoord {
    if (below(4) == 0) {
      return {static_cast<float>(lattice(random)) / 4, static_cast<float>(lattice(random)) / 4};
    }
    return {place(random), place(random)};
  };
  for (int i = 0; i < seams; ++i) {
    TexCoord ends[4];
    for (int side = 0; side < 2; ++side) {
      ends[2 * side] = point();
      ends[2 * side + 1] = below(12) == 0 ? point()
                                          : TexCoord{ends[2 * side].u + step(random),
                                                     ends[2 * side].v + step(random)};
    }
    scene.seam(SlotId{below(6)}, ends[0], ends[1], SlotId{below(6)}, ends[2], ends[3]);
  }
  return scene;
}

TEST(SeamSamplingTest, AgreesWithTheFormulaOnRandomSeams) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    Scene scene = random_scene(seed, 300);
    const NaiveSampler naive(scene);
    const std::vector<SeamEdge> edges = scene.measure();
    ASSERT_EQ(edges.size(), scene.edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      ASSERT_NEAR(edges[i].discrepancy, naive.discrepancy(scene.edges[i]), 1e-10)
          << "seed " << seed << ", edge " << i;
    }
  }
}

using Shape = std::tuple<std::uint64_t, std::size_t>;
class SeamSamplingBudgetTest : public testing::TestWithParam<Shape> {};

TEST_P(SeamSamplingBudgetTest, BitsDoNotDependOnMemoryOrThreads) {
  Scene scene = random_scene(9, 150);
  scene.plan.texmetro = true;
  // More texels than the smallest memory holds, on either side.
  scene.seam(SlotId{4}, {-20, 0.3F}, {20, 7.1F}, SlotId{2}, {0, 0}, {0.5F, 99});
  const std::vector<SeamEdge> want = scene.measure();
  const std::vector<TextureSeams> want_by_texture = scene.texture_seams;
  const auto [kib, workers] = GetParam();
  const std::vector<SeamEdge> got = scene.measure({.budget_bytes = kib << 10, .workers = workers});
  ASSERT_EQ(got.size(), want.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_EQ(got[i].samples, want[i].samples);
    ASSERT_EQ(got[i].discrepancy, want[i].discrepancy) << i;
    ASSERT_EQ(got[i].texmetro_discrepancy, want[i].texmetro_discrepancy) << i;
  }
  ASSERT_EQ(scene.texture_seams.size(), want_by_texture.size());
  for (std::size_t i = 0; i < want_by_texture.size(); ++i) {
    EXPECT_EQ(scene.texture_seams[i].discrepancy, want_by_texture[i].discrepancy);
  }
}

INSTANTIATE_TEST_SUITE_P(Budgets, SeamSamplingBudgetTest,
                         testing::Combine(testing::Values(1024, 3000, 65536),
                                          testing::Values(1, 2, 5)));

}  // namespace
}  // namespace atlasgauge
