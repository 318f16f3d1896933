#include "io/command_line.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

using Arguments = std::vector<std::string>;

Options options_of(Arguments arguments) {
  arguments.insert(arguments.begin(), "model.obj");
  return parse_command_line(arguments).options;
}

/// The text of the error, which is the user's fault.
std::string usage_error(const Arguments& arguments) {
  try {
    options_of(arguments);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    return error.what();
  }
  return "";
}

TEST(CommandLineTest, WhatIsNotGivenHasItsDefault) {
  const Options options = options_of({});
  EXPECT_FALSE(options.charts_path);
  EXPECT_FALSE(options.maps_dir);
  EXPECT_FALSE(options.seams_path);
  EXPECT_FALSE(options.texmetro_seams);
  EXPECT_FALSE(options.tile_texels);
  EXPECT_EQ(options.raster, RasterChoice::kScalar);
}

TEST(CommandLineTest, OutputsAreTakenAsGiven) {
  const Options options = options_of({"--charts", "out/a.csv", "--maps", "out dir"});
  EXPECT_EQ(options.charts_path, "out/a.csv");
  EXPECT_EQ(options.maps_dir, "out dir");
}

TEST(CommandLineTest, ChartsInAnUnknownFormatAreRefused) {
  for (const std::string path : {"charts.txt", "-", "charts", ""}) {
    EXPECT_NE(usage_error({"--charts", path}).find(".jsonl"), std::string::npos) << path;
  }
}

TEST(CommandLineTest, SeamsAreTablesOrPly) {
  for (const std::string path : {"a.csv", "a.JSONL", "a.ndjson", "out/a.ply", "a.Ply"}) {
    EXPECT_EQ(options_of({"--seams", path}).seams_path, path);
  }
  for (const std::string path : {"seams.txt", "-", "ply", "", "a.ply.gz"}) {
    EXPECT_NE(usage_error({"--seams", path}).find(".ply"), std::string::npos) << path;
  }
}

TEST(CommandLineTest, TexmetroSeamsAreAskedFor) {
  EXPECT_TRUE(options_of({"--texmetro-seams"}).texmetro_seams);
}

TEST(CommandLineTest, MapsInNoFolderAreRefused) {
  EXPECT_NE(usage_error({"--maps", ""}).find("--maps"), std::string::npos);
}

TEST(CommandLineTest, RasterIsOneOfTwo) {
  EXPECT_EQ(options_of({"--raster", "osmesa"}).raster, RasterChoice::kOsmesa);
  EXPECT_EQ(options_of({"--raster", "scalar"}).raster, RasterChoice::kScalar);
  EXPECT_NE(usage_error({"--raster", "gpu"}).find("gpu"), std::string::npos);
}

TEST(CommandLineTest, TileSizeIsAPowerOfTwo) {
  EXPECT_EQ(options_of({"--tile-size", "8"}).tile_texels, 8U);
  EXPECT_EQ(options_of({"--tile-size", "4096"}).tile_texels, 4096U);
  for (const std::string size : {"0", "4", "8192", "100", "-8", "8x", "x", "4294967304", "8 "}) {
    EXPECT_NE(usage_error({"--tile-size", size}).find("from 8 to 4096"), std::string::npos) << size;
  }
}

TEST(CommandLineTest, HelpNamesTheOutputs) {
  const std::string help = parse_command_line({"--help"}).text.value_or("");
  for (const char* option : {"--charts FILE", "--seams FILE", "--texmetro-seams", "--maps DIR",
                             "--raster scalar|osmesa"}) {
    EXPECT_NE(help.find(option), std::string::npos) << help;
  }
}

}  // namespace
}  // namespace atlasgauge
