#include "stream/seams/long_seams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "io/warnings.hpp"
#include "stream/seams/seam_sampling.hpp"
#include "tests/stream/mesh/stages.hpp"
#include "tests/stream/seams/memory_textures.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

/// Colours straight from an image, looked up as both ways of sampling should.
class ImageColours {
 public:
  explicit ImageColours(const MemoryImage& image) : image_(image) {}
  void read(const Footprint& footprint, CornerColours& corners) {
    for (std::size_t c = 0; c < 4; ++c) {
      corners[c] =
          colour(footprint.x + static_cast<int>(c % 2), footprint.y + static_cast<int>(c / 2));
    }
  }

 private:
  Colour colour(std::int64_t x, std::int64_t y) const {
    const std::int64_t width = image_.header.size.width, height = image_.header.size.height;
    const auto column = static_cast<std::uint32_t>((x % width + width) % width);
    const auto row = static_cast<std::uint32_t>(height - 1 - (y % height + height) % height);
    Colour colour;
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = image_.component(column, row, static_cast<int>(k));
      colour[k] = image_.header.kind == TexelKind::kByte    ? value
                  : image_.header.kind == TexelKind::kShort ? value / 257.0
                                                            : value * 255.0;
    }
    return colour;
  }

  const MemoryImage& image_;
};

/// Seams on images of all kinds, each of about so many texels.
class LongSeamsTest : public testing::Test {
 protected:
  LongSeamsTest() {
    textures_.add(distinct_texels({64, 64}, TexelKind::kByte));
    textures_.add(distinct_texels({200, 77}, TexelKind::kShort));
    textures_.add(distinct_texels({1, 300}, TexelKind::kFloat));
    textures_.add(distinct_texels({333, 65}, TexelKind::kByte));
  }

  /// Side a has `texels`, in u on slot 0; the other one is shorter.
  void add(double texels, std::uint32_t other, TexCoord from, TexCoord to) {
    SeamCandidate edge{};
    edge.v[0] = VertexId{static_cast<std::uint32_t>(edges_.size())};
    edge.v[1] = VertexId{static_cast<std::uint32_t>(edges_.size() + 1)};
    edge.sides[0] = {SlotId{0}, {{0.25F, 0.3F}, {0.25F + static_cast<float>(texels) / 64, 0.3F}}};
    edge.sides[1] = {SlotId{other}, {from, to}};
    edge.length_3d = 1;
    edge.sampled = true;
    edge.runs_down[1] = true;
    edges_.push_back(edge);
  }

  std::vector<SeamDistances> expected() const {
    TestEngine engine;
    const SlotFrames frames(textures_.frames());
    const SeamEdges edges(spill_of(engine, edges_), frames, true);
    std::vector<SeamDistances> all;
    for (const SeamCandidate& edge : edges_) {
      all.push_back(edges.distances(edge, [&](std::size_t, std::size_t side) {
        return ImageColours(textures_.image(edge.sides[side].slot));
      }));
    }
    return all;
  }

  /// By the exchange of texels or along the edge, as the program chooses.
  std::vector<SeamEdge> sampled(const EngineOptions& options) {
    TestEngine engine(options);
    GroupCollector groups;
    SeamPlan plan;
    plan.decode.open_image = textures_.open();
    plan.texmetro = true;
    Warnings warnings([](const std::string& text) { ADD_FAILURE() << text; });
    sample_seams(engine, spill_of(engine, edges_), textures_.slots(),
                 SlotFrames(textures_.frames()), plan, warnings, groups);
    std::sort(groups.seam_edges.begin(), groups.seam_edges.end(),
              [](const SeamEdge& a, const SeamEdge& b) { return raw(a.v[0]) < raw(b.v[0]); });
    return groups.seam_edges;
  }

  /// All edges along themselves, whatever their length.
  std::map<std::uint32_t, SeamDistances> along(const EngineOptions& options) {
    TestEngine engine(options);
    const SlotFrames frames(textures_.frames());
    const SeamEdges edges(spill_of(engine, edges_), frames, true);
    Warnings warnings([](const std::string& text) { ADD_FAILURE() << text; });
    const TexelStore store =
        decode_images(engine, textures_.slots(), std::vector<bool>(textures_.size(), true),
                      {.model = "model.obj", .open_image = textures_.open()}, warnings);
    std::vector<std::uint32_t> numbers(edges_.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    const std::uint64_t before = engine.scratch.written_bytes();
    std::mutex mutex;
    std::map<std::uint32_t, SeamDistances> found;
    Spill<std::uint32_t> spill = spill_of(engine, numbers);
    compare_along(engine, edges, store, std::move(spill),
                  [&](std::size_t, const SeamCandidate& edge, const SeamDistances& distances) {
                    const std::lock_guard lock(mutex);
                    found[raw(edge.v[0])] = distances;
                  });
    EXPECT_LE(engine.scratch.written_bytes() - before, 4096U) << "but for the numbers";
    return found;
  }

  MemoryTextures textures_;
  std::vector<SeamCandidate> edges_;
};

TEST_F(LongSeamsTest, EdgesOfMoreThan65536SamplesAreLong) {
  add(13'107, 0, {0, 0}, {0.5F, 0});
  add(13'108, 0, {0, 0}, {0.5F, 0});
  TestEngine engine;
  const SlotFrames frames(textures_.frames());
  const SeamEdges edges(spill_of(engine, edges_), frames, true);
  EXPECT_EQ(edges.samples(edges_[0], 0).count, 65'535U);
  EXPECT_FALSE(edges.is_long(edges_[0]));
  EXPECT_EQ(edges.samples(edges_[1], 0).count, 65'540U);
  EXPECT_TRUE(edges.is_long(edges_[1]));
}

TEST_F(LongSeamsTest, BothWaysOfSamplingAgreeBitForBitAroundTheLimit) {
  for (const std::uint32_t other : {0U, 1U, 2U, 3U}) {
    add(13'107, other, {-0.7F, 0.1F}, {3.3F, 2.9F});
    add(13'108, other, {-0.7F, 0.1F}, {3.3F, 2.9F});
    add(40, other, {5, -3}, {5.5F, -3.5F});
  }
  const std::vector<SeamDistances> want = expected();
  for (const EngineOptions& options :
       {EngineOptions{.budget_bytes = 2 << 20, .workers = 1},
        EngineOptions{.budget_bytes = 64 << 20, .block_bytes = 65536, .workers = 3}}) {
    const std::vector<SeamEdge> sampled_edges = sampled(options);
    const auto along_edges = along(options);
    ASSERT_EQ(sampled_edges.size(), want.size());
    ASSERT_EQ(along_edges.size(), want.size());
    for (std::uint32_t i = 0; i < want.size(); ++i) {
      EXPECT_EQ(sampled_edges[i].discrepancy, want[i][0]) << i;
      EXPECT_EQ(sampled_edges[i].texmetro_discrepancy, want[i][1]) << i;
      EXPECT_EQ(along_edges.at(i), want[i]) << i;
    }
  }
}

TEST_F(LongSeamsTest, OneTileOfMemoryIsEnough) {
  add(13'108, 3, {-2, 0.1F}, {5, 9});
  const std::vector<SeamDistances> want = expected();
  // A page of edges, a block, a tile, and little more: not two tiles.
  const EngineOptions tight{
      .budget_bytes = std::uint64_t{512} * 72 + 4096 + kLargestTileBytes + 40'000, .workers = 1};
  ASSERT_LT(tight.budget_bytes, 2 * kLargestTileBytes + std::uint64_t{512} * 72 + 4096);
  EXPECT_EQ(along(tight).at(0), want[0]);
}

TEST_F(LongSeamsTest, TooLittleMemoryIsRefused) {
  add(13'108, 3, {-2, 0.1F}, {5, 9});
  EXPECT_THROW(
      along({.budget_bytes = std::uint64_t{512} * 72 + 4096 + kLargestTileBytes / 2, .workers = 1}),
      Error);
}

TEST_F(LongSeamsTest, NoLongEdgesTakeNoMemory) {
  EXPECT_TRUE(along({.budget_bytes = 400'000, .workers = 8}).empty());
}

}  // namespace
}  // namespace atlasgauge
