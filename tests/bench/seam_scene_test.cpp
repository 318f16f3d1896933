#include "bench/seam_scene.hpp"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

SeamSceneOptions small_scene() {
  SeamSceneOptions options;
  options.edges = 500;
  options.textures = 6;
  options.texture_size_texels = 64;
  options.length_texels = 10;
  options.image_format = "png";
  options.content = SceneContent::kConstant;
  return options;
}

void write(const SeamSceneOptions& options, const TempDir& dir) {
  write_seam_scene(SeamScene(options), dir.path().string(), 2);
}

double length_of(const SceneSide& side, std::size_t from, std::size_t to, double size) {
  return size * std::hypot(side.uv[to][0] - side.uv[from][0], side.uv[to][1] - side.uv[from][1]);
}

template <class Visit>
void for_each_side(const SeamScene& scene, Visit visit) {
  for (std::uint64_t i = 0; i < scene.options().edges; ++i) {
    for (const SceneSide& side : scene.edge(i).sides) visit(side);
  }
}

TEST(SeamSceneTest, SidesSpreadFromHalfOfTheLengthToOneAndAHalf) {
  double least = std::numeric_limits<double>::infinity(), most = 0, sum = 0;
  const SeamScene scene(small_scene());
  for_each_side(scene, [&](const SceneSide& side) {
    const double length = length_of(side, 0, 1, 64);
    least = std::min(least, length);
    most = std::max(most, length);
    sum += length;
  });
  EXPECT_NEAR(least, 5, 0.1);
  EXPECT_NEAR(most, 15, 0.1);
  EXPECT_NEAR(sum / 1000, 10, 0.3);
}

TEST(SeamSceneTest, TrianglesAreHalfAsHighAsTheirSeamIsLong) {
  for_each_side(SeamScene(small_scene()), [](const SceneSide& side) {
    const double half = length_of(side, 0, 1, 64) / 2;
    const double leg = half * std::sqrt(2);
    EXPECT_NEAR(length_of(side, 0, 2, 64), leg, 1e-4);
    EXPECT_NEAR(length_of(side, 1, 2, 64), leg, 1e-4);
  });
}

TEST(SeamSceneTest, TrianglesLieInsideTheirTextures) {
  for_each_side(SeamScene(small_scene()), [](const SceneSide& side) {
    for (const auto& [u, v] : side.uv) {
      EXPECT_GE(std::min(u, v), -1e-6F);
      EXPECT_LE(std::max(u, v), 1 + 1e-6F);
    }
  });
}

TEST(SeamSceneTest, AnyTexturesMeetInAllDirections) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::set<std::pair<bool, bool>> quadrants;
  const SeamScene scene(small_scene());
  for (std::uint64_t i = 0; i < 500; ++i) {
    const auto [a, b] = scene.edge(i).sides;
    pairs.insert({a.texture, b.texture});
    quadrants.insert({a.uv[0][0] < a.uv[1][0], a.uv[0][1] < a.uv[1][1]});
  }
  EXPECT_EQ(pairs.size(), 36U);
  EXPECT_EQ(quadrants.size(), 4U);
}

TEST(SeamSceneTest, SeedsMakeOtherScenes) {
  SeamSceneOptions options = small_scene();
  options.seed = 2;
  EXPECT_NE(SeamScene(small_scene()).edge(0).sides[0].uv, SeamScene(options).edge(0).sides[0].uv);
}

TEST(SeamSceneTest, EqualOptionsGiveEqualFilesForAnyThreads) {
  const TempDir one, two;
  write_seam_scene(SeamScene(small_scene()), one.path().string(), 1);
  write_seam_scene(SeamScene(small_scene()), two.path().string(), 3);
  std::vector<std::string> names = names_in(one.path());
  EXPECT_EQ(names.size(), 9U) << "OBJ, MTL, answers, six images";
  for (const std::string& name : names) {
    EXPECT_EQ(content_of(one.path() / name), content_of(two.path() / name)) << name;
  }
}

/// What an OBJ says, by hand.
struct ReadScene {
  std::vector<std::vector<double>> positions, texcoords;
  std::vector<std::vector<std::uint64_t>> faces;  ///< v, t, v, t, v, t
  std::vector<std::string> materials;             ///< of faces
};

ReadScene read_scene(const TempDir& dir) {
  ReadScene scene;
  std::ifstream file(dir.path() / "seams.obj");
  std::string material;
  for (std::string line; std::getline(file, line);) {
    std::replace(line.begin(), line.end(), '/', ' ');
    std::istringstream words(line);
    std::string word;
    words >> word;
    const auto numbers = [&]<class Number>(Number number) {
      std::vector<Number> list;
      while (words >> number) list.push_back(number);
      return list;
    };
    if (word == "v") scene.positions.push_back(numbers(0.0));
    if (word == "vt") scene.texcoords.push_back(numbers(0.0));
    if (word == "usemtl") words >> material;
    if (word != "f") continue;
    scene.faces.push_back(numbers(std::uint64_t{0}));
    scene.materials.push_back(material);
  }
  return scene;
}

class SeamSceneFileTest : public testing::Test {
 protected:
  const TempDir dir_;
  const SeamScene scene_{small_scene()};
  const ReadScene read_ = (write(small_scene(), dir_), read_scene(dir_));
};

TEST_F(SeamSceneFileTest, HasTheNumbersThatItPromises) {
  EXPECT_EQ(read_.positions.size(), scene_.vertices());
  EXPECT_EQ(read_.positions.size(), 2500U);
  EXPECT_EQ(read_.texcoords.size(), 3000U);
  EXPECT_EQ(read_.faces.size(), scene_.faces());
}

TEST_F(SeamSceneFileTest, FacesHaveTheirTexturesAndUvs) {
  for (std::size_t f = 0; f < read_.faces.size(); ++f) {
    const SceneSide side = scene_.edge(f / 2).sides[f % 2];
    EXPECT_EQ(read_.materials[f], "m" + std::to_string(side.texture));
    const std::vector<std::size_t> corners =
        f % 2 == 0 ? std::vector<std::size_t>{0, 1, 2} : std::vector<std::size_t>{1, 0, 2};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& read = read_.texcoords.at(read_.faces[f][2 * k + 1] - 1);
      EXPECT_EQ(static_cast<float>(read.at(0)), side.uv[corners[k]][0]);
      EXPECT_EQ(static_cast<float>(read.at(1)), side.uv[corners[k]][1]);
    }
  }
}

TEST_F(SeamSceneFileTest, FacesOfAnEdgeShareItByIndexOrByPosition) {
  for (std::size_t e = 0; e < 500; ++e) {
    const auto &left = read_.faces[2 * e], &right = read_.faces[2 * e + 1];
    const auto at = [&](const std::vector<std::uint64_t>& face, std::size_t corner) {
      return read_.positions.at(face[2 * corner] - 1);
    };
    EXPECT_EQ(at(left, 0), at(right, 1));
    EXPECT_EQ(at(left, 1), at(right, 0));
    EXPECT_EQ(left[0] == right[2], e % 2 == 0);
    EXPECT_EQ(left[2] == right[0], e % 2 == 0);
    EXPECT_EQ(at(left, 1)[1] - at(left, 0)[1], static_cast<double>(scene_.edge(e).length_3d));
  }
}

TEST_F(SeamSceneFileTest, EdgesHavePlacesOfTheirOwn) {
  std::set<std::vector<double>> places;
  for (const auto& position : read_.positions) places.insert(position);
  EXPECT_EQ(places.size(), 4U * 500U);
}

TEST_F(SeamSceneFileTest, ImagesHaveOneColourEach) {
  for (std::uint32_t texture = 0; texture < 6; ++texture) {
    const std::string path = (dir_.path() / scene_.texture_names()[texture]).string();
    const auto image = OIIO::ImageInput::open(path);
    ASSERT_TRUE(image) << path;
    ASSERT_EQ(image->spec().width, 64);
    ASSERT_EQ(image->spec().height, 64);
    ASSERT_EQ(image->spec().nchannels, 3);
    std::vector<std::uint8_t> texels(64 * 64 * 3);
    ASSERT_TRUE(image->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, texels.data()));
    const auto colour = scene_.colour(texture);
    for (std::size_t i = 0; i < texels.size(); ++i) ASSERT_EQ(texels[i], colour[i % 3]);
  }
}

TEST(SeamSceneTest, ImagesComeInTheFormatsAskedFor) {
  for (const std::string format : {"jpg", "png", "tif"}) {
    SeamSceneOptions options = small_scene();
    options.image_format = format;
    options.content = SceneContent::kPhoto;
    const TempDir dir;
    write(options, dir);
    const auto image = OIIO::ImageInput::open((dir.path() / ("seams_5." + format)).string());
    ASSERT_TRUE(image) << format;
    EXPECT_EQ(image->spec().width, 64);
  }
}

TEST(SeamSceneTest, ColoursAreDistinctAndExactUnderBilinearLookups) {
  SeamSceneOptions options = small_scene();
  options.textures = 729;
  const SeamScene scene(options);
  std::set<std::array<std::uint8_t, 3>> colours;
  for (std::uint32_t texture = 0; texture < 729; ++texture) colours.insert(scene.colour(texture));
  EXPECT_EQ(colours.size(), 729U);
  for (const auto& colour : colours) {
    for (const double c : colour) {
      for (double t = 1e-9; t < 1; t += 0.00123) EXPECT_EQ(c * (1 - t) + c * t, c);
    }
  }
}

TEST(SeamSceneTest, CountsFivePairsForEachBegunTexelOfTheLongerSide) {
  SeamSceneOptions options = small_scene();
  options.edges = 1;
  const SeamScene scene(options);
  const auto [a, b] = scene.edge(0).sides;
  const double longer = std::max(length_of(a, 0, 1, 64), length_of(b, 0, 1, 64));
  EXPECT_EQ(scene.sample_pairs(), 5 * static_cast<std::uint64_t>(std::ceil(longer)));
}

/// The statistics of the edges, straight from the definitions.
TEST(SeamSceneTest, AnswersAreTheWeightedStatisticsOfTheColoursDistances) {
  const SeamScene scene(small_scene());
  double length = 0, sum = 0, squares = 0, length_0 = 0, sum_0 = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const SceneEdge edge = scene.edge(i);
    const auto a = scene.colour(edge.sides[0].texture), b = scene.colour(edge.sides[1].texture);
    const double d = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    const auto weight = static_cast<double>(edge.length_3d);
    length += weight;
    sum += weight * d;
    squares += weight * d * d;
    if (edge.sides[0].texture != 0 && edge.sides[1].texture != 0) continue;
    length_0 += weight;
    sum_0 += weight * d;
  }
  const nlohmann::json values = seam_scene_answers(scene).values;
  const auto value = [&](const char* key) { return values.at(key).get<double>(); };
  const double mean = sum / length;
  EXPECT_EQ(value("seam_len"), length);
  EXPECT_EQ(value("seam_discrepancy_min"), 0) << "some edges have one texture on both sides";
  EXPECT_NEAR(value("seam_discrepancy_avg"), mean, 1e-10);
  EXPECT_NEAR(value("seam_discrepancy_rms"), std::sqrt(squares / length), 1e-10);
  EXPECT_NEAR(value("seam_discrepancy_var"), squares / length - mean * mean, 1e-8);
  EXPECT_NEAR(values.at("seam_discrepancy_by_texture").at(0).get<double>(), sum_0 / length_0,
              1e-10);
}

TEST(SeamSceneTest, TexturesWithoutSeamsHaveNoMean) {
  SeamSceneOptions options = small_scene();
  options.edges = 1;
  const nlohmann::json means =
      seam_scene_answers(SeamScene(options)).values.at("seam_discrepancy_by_texture");
  ASSERT_EQ(means.size(), 6U);
  EXPECT_GE(std::count(means.begin(), means.end(), nlohmann::json()), 4);
}

TEST(SeamSceneTest, PhotosHaveNoKnownDiscrepancy) {
  SeamSceneOptions options = small_scene();
  options.content = SceneContent::kPhoto;
  EXPECT_FALSE(seam_scene_answers(SeamScene(options)).values.contains("seam_discrepancy_avg"));
}

TEST(SeamSceneTest, RefusesWhatItCannotMake) {
  const auto refuses = [](const std::function<void(SeamSceneOptions&)>& change) {
    SeamSceneOptions options = small_scene();
    change(options);
    EXPECT_THROW(SeamScene{options}, Error);
  };
  refuses([](SeamSceneOptions& o) { o.edges = 0; });
  refuses([](SeamSceneOptions& o) { o.textures = 0; });
  refuses([](SeamSceneOptions& o) { o.length_texels = 0.5; });
  refuses([](SeamSceneOptions& o) { o.length_texels = 33; });
  refuses([](SeamSceneOptions& o) { o.length_texels = std::nan(""); });
  refuses([](SeamSceneOptions& o) { o.texture_size_texels = 65536; });
  refuses([](SeamSceneOptions& o) { o.image_format = "bmp"; });
  refuses([](SeamSceneOptions& o) { o.image_format = "jpg"; });
}

TEST(SeamSceneTest, SaysThatItCannotWrite) {
  EXPECT_THROW(write_seam_scene(SeamScene(small_scene()), "/nowhere/at/all", 2), Error);
}

}  // namespace
}  // namespace atlasgauge
