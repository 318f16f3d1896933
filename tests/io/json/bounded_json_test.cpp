#include "io/json/bounded_json.hpp"

#include <gtest/gtest.h>

#include <string>

#include "io/error.hpp"
#include "tests/support/input_error.hpp"

namespace atlasgauge {
namespace {

nlohmann::json parse(const std::string& text, const JsonLimits& limits = {}) {
  return parse_json(text, "a.json", limits, [](std::string_view key) { return key != "unwanted"; });
}

TEST(BoundedJsonTest, KeepsWhatIsWanted) {
  EXPECT_EQ(parse(R"({"a":[1,-2,3.5,"x",true,null,{}],"b":{"c":[[]]}})"),
            nlohmann::json::parse(R"({"a":[1,-2,3.5,"x",true,null,{}],"b":{"c":[[]]}})"));
  EXPECT_EQ(parse("7"), 7);
}

TEST(BoundedJsonTest, MembersThatAreNotWantedTakeNoMemory) {
  std::string numbers = "[0";
  for (int i = 0; i < 1000; ++i) numbers += ",0";
  const std::string text = R"({"unwanted":{"a":)" + numbers + R"(]},"b":1})";
  EXPECT_EQ(parse(text, {text.size() + 1000, 8}), nlohmann::json({{"b", 1}}));
}

TEST(BoundedJsonTest, WhatTakesMoreMemoryThanTheLimitIsRefused) {
  std::string text = "[0";
  for (int i = 0; i < 1000; ++i) text += ",0";
  text += "]";
  const std::size_t takes = 1000 * sizeof(nlohmann::json);
  try {
    parse(text, {text.size() + takes, 8});
    FAIL() << "it was parsed";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    EXPECT_TRUE(says(error.what(), "a.json: its JSON takes more than"));
  }
  EXPECT_EQ(parse(text, {text.size() + 4 * takes, 8}).size(), 1001U);
}

TEST(BoundedJsonTest, DepthIsLimitedInWantedAndUnwantedValues) {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  EXPECT_TRUE(parse(nested(64), {1 << 20, 64}).is_array());
  EXPECT_TRUE(says(input_error_of([&] {
                     parse(nested(65), {1 << 20, 64});
                   }),
                   "found JSON nested deeper than 64 levels"));
  const std::string hidden = R"({"unwanted":)" + nested(100) + "}";
  EXPECT_TRUE(says(input_error_of([&] { parse(hidden, {1 << 20, 64}); }), "nested deeper"));
  EXPECT_TRUE(says(input_error_of([&] {
                     parse(std::string(1 << 20, '['), {1 << 30, 64});
                   }),
                   "nested deeper"));
}

TEST(BoundedJsonTest, WhatIsNoJsonIsAnErrorWithItsPlace) {
  for (const char* const text : {"", "{", "[1,]", "{\"a\"}", "nul", "\"\xFF\"", "1e999", "[1]2"}) {
    EXPECT_TRUE(says(input_error_of([&] { parse(text); }), "a.json: found broken JSON")) << text;
  }
  EXPECT_TRUE(says(input_error_of([&] { parse("{\n\"a\":x}"); }), "line 2"));
  const std::string longest(100000, 'x');
  EXPECT_LT(input_error_of([&] { parse("\"" + longest); }).size(), 300U);
}

}  // namespace
}  // namespace atlasgauge
