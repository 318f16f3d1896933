#include "stream/estimate.hpp"

#include <gtest/gtest.h>

#include <string>

#include "io/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

MemoryPlan plan_of(std::uint64_t limit_bytes) {
  MemoryWishes wishes;
  wishes.limit_bytes = limit_bytes;
  return plan_memory(wishes, 2);
}

ModelGuess scan_of(double faces) {
  ModelGuess guess;
  guess.faces = faces;
  guess.positions = faces / 2;
  guess.texcoords = faces * 0.6;
  guess.text_bytes = faces * 75;
  return guess;
}

std::string refusal_of(const ModelGuess& guess, const CostEstimate& cost, const MemoryPlan& plan,
                       const std::string& directory) {
  try {
    require_resources(guess, cost, plan, directory);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    return error.what();
  }
  return "";
}

ImageHeader any_image(const ImageSource&) {
  return {.size = {100, 64}};
}

ModelGuess guess_of(const std::string& model) {
  return guess_model({&model, 1}, {.probe = any_image});
}

TEST(EstimateTest, CountsOfASmallModelAreExact) {
  const TempDir dir;
  const ModelGuess guess =
      guess_of(dir.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1 2 3 4\n"));
  EXPECT_TRUE(guess.is_whole);
  EXPECT_EQ(guess.positions, 4);
  EXPECT_EQ(guess.texcoords, 1);
  EXPECT_EQ(guess.faces, 2);
  EXPECT_EQ(guess.images, 0U);
}

TEST(EstimateTest, ImagesCountOnlyWhenTheyAreThere) {
  const TempDir dir;
  dir.write("a.mtl", "newmtl m\nmap_Kd a.png\n");
  const std::string model = dir.write("a.obj", "mtllib a.mtl\nv 0 0 0\n");
  EXPECT_EQ(guess_of(model).images, 0U);
  dir.write("a.png", "");
  const ModelGuess guess = guess_of(model);
  EXPECT_EQ(guess.images, 1U);
  EXPECT_EQ(guess.texels, 100 * 64);
  EXPECT_EQ(guess.largest_side_texels, 100);
  EXPECT_EQ(guess.decoded_bytes, 12288 + 8192) << "36 columns of the second tile are two pages";
}

TEST(EstimateTest, RandomOrderShowsInTheTablesThatFacesLoad) {
  const TempDir dir;
  std::string in_order, random;
  constexpr std::uint32_t kVertices = 50'000'000;
  for (std::uint32_t i = 1; i + 2 < 20'000; ++i) {
    const auto index = [&](std::uint32_t v) { return " " + std::to_string(v); };
    const auto far = [&](std::uint32_t v) { return index(v * 2654435761U % kVertices + 1); };
    in_order += "f" + index(i) + index(i + 1) + index(i + 2) + "\n";
    random += "f" + far(3 * i) + far(3 * i + 1) + far(3 * i + 2) + "\n";
  }
  EXPECT_LT(guess_of(dir.write("a.obj", in_order)).loaded_bytes_per_face, 100);
  EXPECT_GT(guess_of(dir.write("b.obj", random)).loaded_bytes_per_face, 600);
}

TEST(EstimateTest, MemoryOfAHugeModelIsBelowTheLimit) {
  for (const std::uint64_t mib : {256U, 512U, 4096U}) {
    EXPECT_LT(estimate_cost(scan_of(1e9), plan_of(mib * kMiB)).resident_bytes, mib * kMiB);
  }
}

TEST(EstimateTest, ScratchBeyondThePoolIsOnDisk) {
  const MemoryPlan plan = plan_of(256 * kMiB);
  const CostEstimate cost = estimate_cost(scan_of(1e7), plan);
  EXPECT_EQ(cost.scratch_file_bytes, cost.scratch_bytes - plan.resident_bytes);
  EXPECT_EQ(estimate_cost(scan_of(100), plan).scratch_file_bytes, 0U);
}

TEST(EstimateTest, MoreThreadsTakeLessTime) {
  MemoryWishes wishes;
  wishes.limit_bytes = 1024 * kMiB;
  const double one = estimate_cost(scan_of(1e7), plan_memory(wishes, 1)).wall_seconds;
  EXPECT_LT(estimate_cost(scan_of(1e7), plan_memory(wishes, 4)).wall_seconds, one);
}

TEST(EstimateTest, TooSmallADiskIsRefusedWithTheNeed) {
  const TempDir dir;
  CostEstimate cost;
  cost.scratch_file_bytes = std::uint64_t{1} << 60;
  const std::string text = refusal_of(scan_of(1e6), cost, plan_of(256 * kMiB), dir.path().string());
  EXPECT_NE(text.find("1.0 EiB"), std::string::npos) << text;
  EXPECT_NE(text.find("--tmp-dir"), std::string::npos) << text;
  EXPECT_NE(text.find(dir.path().string()), std::string::npos) << text;
}

TEST(EstimateTest, EnoughDiskIsNotRefused) {
  const TempDir dir;
  CostEstimate cost;
  cost.scratch_file_bytes = 4096;
  EXPECT_EQ(refusal_of(scan_of(1e6), cost, plan_of(256 * kMiB), dir.path().string()), "");
}

TEST(EstimateTest, TooManyNodesForTheMemoryAreRefusedWithALimitThatDoes) {
  MemoryWishes wishes;
  wishes.limit_bytes = 256 * kMiB;
  wishes.threads = 40;
  const std::string text = refusal_of(scan_of(1e9), {}, plan_memory(wishes, 2), "/");
  EXPECT_NE(text.find("512.0 MiB"), std::string::npos) << text;
  wishes.limit_bytes = 512 * kMiB;
  EXPECT_EQ(refusal_of(scan_of(1e9), {}, plan_memory(wishes, 2), "/"), "");
}

TEST(EstimateTest, ASampleIsTakenWhereTheSizeOfTheFileDoesNotSettleIt) {
  const TempDir dir;
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 20'000; ++i) text += "f 1 2 3\n";
  const std::string model = dir.write("a.obj", text);
  MemoryWishes wishes;
  wishes.engine_bytes = 2 * kMiB;
  const MemoryPlan plan = plan_memory(wishes, 2);
  EXPECT_NO_THROW(
      require_resources_for({&model, 1}, plan, dir.path().string(), {.probe = any_image}));
  EXPECT_THROW(require_resources_for({&model, 1}, plan, "/proc", {.probe = any_image}), Error)
      << "which has no free space";
}

TEST(EstimateTest, MissingDirectoryIsLeftToTheRun) {
  CostEstimate cost;
  cost.scratch_file_bytes = std::uint64_t{1} << 60;
  EXPECT_EQ(refusal_of(scan_of(1e6), cost, plan_of(256 * kMiB), "/no/such/folder"), "");
}

}  // namespace
}  // namespace atlasgauge
