#include "stream/raster/atlas_maps.hpp"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/image/image_module.hpp"
#include "stream/raster/bin_triangle.hpp"
#include "stream/raster/map_preview.hpp"
#include "stream/raster/scalar_raster.hpp"
#include "tests/support/engine_fixture.hpp"
#include "tests/support/module_folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

AtlasFace face_at(const std::array<TexCoord, 3>& uv, std::uint32_t slot) {
  Triangle triangle{};
  triangle.kind = FaceKind::kWhole;
  triangle.slot = SlotId{slot};
  triangle.has_uv_triangle = true;
  for (std::size_t k = 0; k < 3; ++k) triangle.t[k] = uv[k];
  return AtlasFace(triangle);
}

/// What a model has, before it is an AtlasStore.
struct Atlas {
  std::vector<ImageSize> sizes;
  std::vector<AtlasFace> faces;
  std::vector<std::uint32_t> charts;
  std::vector<float> distortions;

  void add(const std::array<TexCoord, 3>& uv, std::uint32_t chart, std::uint32_t slot = 0,
           float distortion = 1) {
    faces.push_back(face_at(uv, slot));
    charts.push_back(chart);
    distortions.push_back(distortion);
  }

  SlotFrames frames() const {
    std::vector<SlotFrame> frames;
    for (const ImageSize& size : sizes) {
      SlotFrame& frame = frames.emplace_back();
      frame.has_size = true;
      frame.width = size.width;
      frame.height = size.height;
    }
    return SlotFrames(std::move(frames));
  }

  AtlasStore store(TestEngine& engine) const {
    std::vector<Label> labels;
    for (const std::uint32_t chart : charts) labels.emplace_back(chart, false, false);
    const std::vector<double> areas_3d(faces.size(), 0.5);
    return {spill_of(engine, labels), spill_of(engine, faces), spill_of(engine, areas_3d),
            spill_of(engine, distortions), frames()};
  }

  TextureSlots slots() const {
    TextureSlots slots;
    for (const ImageSize& size : sizes) slots.slots.push_back({"a/b.png", {}, size, true});
    return slots;
  }
};

/// One level of a map, rows from the top.
struct LevelPixels {
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<float> values;

  float at(const std::string& channel, int x, int row) const {
    const auto c = std::find(channels.begin(), channels.end(), channel) - channels.begin();
    const std::size_t pixel = static_cast<std::size_t>(row * width + x);
    const float value = values[pixel * channels.size() + static_cast<std::size_t>(c)];
    return channel == "chart" ? value * 0x1p32F : value;  // as OpenImageIO reads integers
  }
};

LevelPixels read_level(const std::string& path, int level) {
  const auto file = OIIO::ImageInput::open(path);
  LevelPixels pixels;
  if (!file || !file->seek_subimage(0, level)) return pixels;
  const OIIO::ImageSpec& spec = file->spec();
  pixels.width = spec.width;
  pixels.height = spec.height;
  pixels.channels = spec.channelnames;
  pixels.values.resize(static_cast<std::size_t>(spec.width) *
                       static_cast<std::size_t>(spec.height) * pixels.channels.size());
  EXPECT_TRUE(
      file->read_image(0, level, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.values.data()));
  return pixels;
}

class AtlasMapsTest : public testing::Test {
 protected:
  void SetUp() override { show_modules(kImageModuleFile); }
  void write(const Atlas& atlas, double unit = 1, const EngineOptions& options = {}) {
    TestEngine engine(options);
    write_maps(engine, atlas.store(engine), atlas.slots(), unit, dir_.path().string());
    EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
  }
  std::string path(const std::string& name) const { return (dir_.path() / name).string(); }

  TempDir dir_;
};

TEST_F(AtlasMapsTest, ShowsTheHighestFaceOfTheHighestChart) {
  Atlas atlas;
  atlas.sizes = {{4, 2}};
  atlas.add({{{0, 0}, {0.75F, 0}, {0, 1}}}, 0, 0, 1.5F);  // lower left, of chart 0
  atlas.add({{{0, 0}, {0, 1}, {0.25F, 0}}}, 0, 0, 3);     // over it, mirrored, narrower
  atlas.add({{{1, 0}, {1, 1}, {0.5F, 1}}}, 2);            // upper right, of chart 2
  write(atlas, 2);
  const LevelPixels pixels = read_level(path("0000_b.exr"), 0);
  ASSERT_EQ(pixels.width, 4);
  // Bottom row: the centre of its first texel lies in both faces of chart 0, and the map shows the
  // second: 1 texel^2 on 1/2, in units of 2.
  EXPECT_EQ(pixels.at("n", 0, 1), 2);
  EXPECT_EQ(pixels.at("chart", 0, 1), 1);
  EXPECT_EQ(pixels.at("qcd", 0, 1), 3);
  EXPECT_EQ(pixels.at("sign", 0, 1), -1);
  EXPECT_EQ(pixels.at("s_f", 0, 1), 1);
  EXPECT_EQ(pixels.at("n", 1, 1), 1);
  EXPECT_EQ(pixels.at("s_f", 1, 1), 3);
  EXPECT_EQ(pixels.at("sign", 1, 1), 1);
  EXPECT_EQ(pixels.at("chart", 3, 0), 3);
  EXPECT_EQ(pixels.at("n", 2, 1), 0);
  EXPECT_EQ(pixels.at("chart", 2, 1), 0);
}

TEST_F(AtlasMapsTest, EveryLevelIsDrawnForItself) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-0.2F, 1.2F), offset(-0.1F, 0.1F);
  Atlas atlas;
  atlas.sizes = {{100, 37}, {7, 5}, {3, 3}};
  for (std::uint32_t i = 0; i < 600; ++i) {
    const float u = place(random), v = place(random);
    std::array<TexCoord, 3> uv{};
    for (TexCoord& t : uv) t = {u + offset(random), v + offset(random)};
    atlas.add(uv, i / 7, i % 2);
  }
  for (const std::uint64_t budget : {64U << 20, 2U << 20}) {
    write(atlas, 1, {.budget_bytes = budget});
    for (std::uint32_t slot = 0; slot < 3; ++slot) {
      const ImageSize size = atlas.sizes[slot];
      for (int level = 0; level < 3 && (size.height >> level) > 0; ++level) {
        const LevelSize level_size{size.width >> level, size.height >> level};
        TexelTile tile;
        tile.reset({0, 0, level_size.width, level_size.height}, level_size);
        const SlotFrames frames = atlas.frames();
        const SlotFrame frame = at_level(frames.of(SlotId{slot}), level_size);
        for (std::size_t i = 0; i < atlas.faces.size(); ++i) {
          const AtlasFace& face = atlas.faces[i];
          if (raw(face.slot()) != slot) continue;
          const SnappedTriangle snapped_face =
              snapped({slot, atlas.charts[i], {face.uv(0), face.uv(1), face.uv(2)}}, frame);
          ScalarRaster().draw({&snapped_face, 1}, tile);
        }
        const LevelPixels pixels = read_level(path("000" + std::to_string(slot) + "_b.exr"), level);
        ASSERT_EQ(pixels.width, level_size.width);
        ASSERT_EQ(pixels.height, level_size.height);
        for (int row = 0; row < pixels.height; ++row) {
          for (int x = 0; x < pixels.width; ++x) {
            const std::size_t at = tile.index(x, pixels.height - 1 - row);
            const std::uint32_t n = tile.counts()[at] & ~TexelTile::kSeveralCharts;
            ASSERT_EQ(pixels.at("n", x, row), static_cast<float>(n)) << level << x << ' ' << row;
            ASSERT_EQ(pixels.at("chart", x, row), static_cast<float>(tile.charts()[at]));
          }
        }
      }
    }
  }
}

TEST_F(AtlasMapsTest, ThePreviewTellsOverlapsApart) {
  Atlas atlas;
  atlas.sizes = {{4, 1}};
  const auto column = [&](float from, float to, std::uint32_t chart) {
    atlas.add({{{from, 0}, {to, 0}, {to, 1}}}, chart);
    atlas.add({{{from, 0}, {to, 1}, {from, 1}}}, chart);
  };
  column(0.25F, 1, 0);
  column(0.5F, 0.75F, 0);
  column(0.75F, 1, 1);
  write(atlas);
  const LevelPixels pixels = read_level(path("0000_b.png"), 0);
  ASSERT_EQ(pixels.width, 4);
  const auto red = [&](int x) { return std::lround(255 * pixels.at("R", x, 0)); };
  EXPECT_EQ(red(0), 255) << "empty";
  EXPECT_EQ(red(1), 166) << "once";
  EXPECT_EQ(red(2), 230) << "within a chart";
  EXPECT_EQ(red(3), 0) << "between charts";
}

TEST(MapPreviewTest, LargeTexturesAreShownSmaller) {
  EXPECT_EQ(MapPreview({65536, 4096}).size().width, 2048U);
  EXPECT_EQ(MapPreview({65536, 4096}).size().height, 128U);
  EXPECT_EQ(MapPreview({2049, 1}).size().width, 1025U);
  EXPECT_EQ(MapPreview({2048, 7}).size().height, 7U);
}

TEST(MapPreviewTest, OverlapShowsHoweverSmallAndCoverageByMajority) {
  MapPreview preview({4096, 2});  // two texels a pixel
  MapTile tile(8);
  tile.reset({0, 0, 8, 2});
  const auto draw = [&](std::int64_t x, std::int64_t y, std::uint32_t chart) {
    tile.draw({{256 * x, 256 * x + 512, 256 * x}, {256 * y, 256 * y, 256 * y + 512}, chart}, {});
  };
  draw(0, 1, 0);  // one texel of four
  draw(6, 1, 0);
  draw(6, 1, 4);
  preview.add(tile);
  const std::vector<std::uint8_t> rgb = preview.rgb();
  EXPECT_EQ(rgb[0], 255) << "mostly empty";
  EXPECT_EQ(rgb[9], 0) << "one texel of two charts";
}

}  // namespace
}  // namespace atlasgauge
