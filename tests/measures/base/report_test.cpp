#include "measures/base/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "measures/base/statistics.hpp"

namespace atlasgauge {
namespace {

std::vector<std::string> keys_of(const Report& report) {
  std::vector<std::string> keys;
  const Json json = report.to_json();
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  return keys;
}

std::ptrdiff_t place_of(const std::vector<std::string>& keys, const std::string& key) {
  const auto found = std::find(keys.begin(), keys.end(), key);
  EXPECT_NE(found, keys.end()) << key;
  return found - keys.begin();
}

TEST(ReportTest, KeysComeInTheOrderOfTheSpecification) {
  const std::vector<std::string> keys = keys_of(Report());
  const std::vector<std::string> begin{"schema_version", "mesh", "fn", "vn", "en", "en_b"};
  EXPECT_TRUE(std::equal(begin.begin(), begin.end(), keys.begin()));
  const std::vector<std::string> some{"area",
                                      "genus",
                                      "orientable",
                                      "num_charts",
                                      "mapped_fraction",
                                      "occupancy",
                                      "qcd_perc1",
                                      "qcd_perc99",
                                      "qcd_min",
                                      "qcd_stddev",
                                      "qcd_discardedArea",
                                      "sf_perc1",
                                      "seam_discrepancy_avg",
                                      "crumbliness",
                                      "vndup",
                                      "thin_charts_area_fraction",
                                      "seam_discrepancy_by_texture",
                                      "worst_seams"};
  for (std::size_t i = 1; i < some.size(); ++i) {
    EXPECT_LT(place_of(keys, some[i - 1]), place_of(keys, some[i])) << some[i];
  }
}

TEST(ReportTest, KeysAreDistinct) {
  std::vector<std::string> keys = keys_of(Report());
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

TEST(ReportTest, OrderDoesNotDependOnTheOrderOfSetting) {
  Report a, b;
  a.set("fn", std::uint64_t{1});
  a.set("area", 2.5);
  b.set("area", 2.5);
  b.set("fn", std::uint64_t{1});
  EXPECT_EQ(a.to_json().dump(), b.to_json().dump());
}

TEST(ReportTest, WhatNothingMeasuredIsNull) {
  const Json json = Report().to_json();
  EXPECT_TRUE(json.at("occupancy").is_null());
  EXPECT_EQ(json.at("schema_version"), 1);
}

TEST(ReportTest, ValuesThatDoNotExistAreNull) {
  Report report;
  report.set("area", std::numeric_limits<double>::quiet_NaN());
  report.set("solidity", std::numeric_limits<double>::infinity());
  report.set("crumbliness", -std::numeric_limits<double>::infinity());
  const Json json = report.to_json();
  for (const char* key : {"area", "solidity", "crumbliness"}) EXPECT_TRUE(json.at(key).is_null());
}

TEST(ReportTest, TypesAreKept) {
  Report report;
  report.set("fn", ~std::uint64_t{0});
  report.set("genus", std::int64_t{-1});
  report.set("oriented", true);
  report.set("area", 0.1);
  report.set("mesh", Json("a.obj"));
  const Json json = report.to_json();
  EXPECT_EQ(json.at("fn").dump(), "18446744073709551615");
  EXPECT_EQ(json.at("genus").dump(), "-1");
  EXPECT_EQ(json.at("oriented").dump(), "true");
  EXPECT_EQ(json.at("area").dump(), "0.1");
  EXPECT_EQ(json.at("mesh").dump(), "\"a.obj\"");
}

TEST(ReportTest, UnknownKeysComeLastByName) {
  Report report;
  report.set("zebra", 1.0);
  report.set("fn", std::uint64_t{1});
  report.set("aardvark", 2.0);
  const std::vector<std::string> keys = keys_of(report);
  EXPECT_EQ(keys[keys.size() - 2], "aardvark");
  EXPECT_EQ(keys[keys.size() - 1], "zebra");
}

TEST(ReportTest, EveryTextureHasItsKeyInNumericOrder) {
  Report report;
  report.set_textures(12, [] { return [] { return Json::array(); }; });
  const std::vector<std::string> keys = keys_of(report);
  EXPECT_EQ(place_of(keys, "texture_2") + 8, place_of(keys, "texture_10"));
  EXPECT_EQ(place_of(keys, "textures") + 1, place_of(keys, "texture_0"));
}

// Would take minutes if every key were looked for among those before.
TEST(ReportTest, KeysOfVeryManyTexturesComeOnceEach) {
  constexpr std::uint64_t kTextures = 100'000;
  Report report;
  report.set_textures(kTextures, [] { return [] { return Json::array(); }; });
  const std::size_t others = Report().to_json().size();
  EXPECT_EQ(report.to_json().size(), others + kTextures);
}

TEST(ReportTest, WritesWhatItsJsonSaysWithALineForEveryLevel) {
  Report report;
  report.set("mesh", Json("line\nend"));
  report.set("textures", Json::array({"a.png", "b.png"}));
  report.set_textures(2, [] {
    return [i = 0]() mutable {
      return i++ == 0 ? Json::array({{{"rw", 2}}, {{"rw", 1}}}) : Json::array();
    };
  });
  std::string text;
  report.write([&](std::string_view piece) { text += piece; });
  EXPECT_EQ(Json::parse(text), report.to_json());
  EXPECT_NE(text.find(" \"texture_0\": [\n  {\"rw\":2},\n  {\"rw\":1}\n ],\n \"texture_1\": [],\n"),
            std::string::npos)
      << text;
}

TEST(ReportTest, WritesALineForEveryObjectOfAnyList) {
  Report report;
  report.set("worst_seams", Json::array({{{"from", Json::array({1.5, 2})}}, {{"from", 3}}}));
  report.set("seam_discrepancy_by_texture", Json::array());
  std::string text;
  report.write([&](std::string_view piece) { text += piece; });
  EXPECT_EQ(Json::parse(text), report.to_json());
  EXPECT_NE(text.find(" \"seam_discrepancy_by_texture\": [],\n"
                      " \"worst_seams\": [\n  {\"from\":[1.5,2]},\n  {\"from\":3}\n ]\n}"),
            std::string::npos)
      << text;
}

TEST(ReportTest, SettingAgainReplaces) {
  Report report;
  report.set("area", 1.0);
  report.set("area", 2.0);
  EXPECT_EQ(report.at("area"), 2.0);
}

TEST(ReportTest, MissingKeyIsAnInternalErrorThatNamesIt) {
  try {
    Report().at("nothing");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInternal);
    EXPECT_NE(std::string(error.what()).find("nothing"), std::string::npos);
  }
}

TEST(StatisticsTest, MomentsGoUnderTheirKeys) {
  WeightedMoments moments;
  moments.add(1, 1);
  moments.add(2, 2);
  moments.add(4, 1);
  Report report;
  report_moments(report, "x", moments);
  EXPECT_EQ(report.at("x_min"), 1);
  EXPECT_EQ(report.at("x_max"), 4);
  EXPECT_EQ(report.at("x_avg"), 2.25);
  EXPECT_EQ(report.at("x_rms"), 2.5);
  EXPECT_EQ(report.at("x_var"), 1.1875);
}

TEST(StatisticsTest, PercentilesGoUnderTheirKeys) {
  PercentileValues values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
  Report report;
  report_percentiles(report, "x", values);
  EXPECT_EQ(report.at("x_perc1"), 0);
  EXPECT_EQ(report.at("x_perc10"), 1);
  EXPECT_EQ(report.at("x_perc90"), 9);
  EXPECT_EQ(report.at("x_perc99"), 10);
}

}  // namespace
}  // namespace atlasgauge
