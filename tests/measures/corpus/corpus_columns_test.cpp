#include "measures/corpus/corpus_columns.hpp"

#include <gtest/gtest.h>

namespace atlasgauge {
namespace {

using Keys = std::vector<std::string>;

bool any(const Json& /*value*/) {
  return true;
}

bool single(const Json& value) {
  return !value.is_structured();
}

TEST(CorpusColumnsTest, AKeyThatOnlySomeHaveComesAfterItsNeighbour) {
  CorpusColumns columns;
  columns.add(Json::parse(R"({"a": 1, "c": 2, "d": 3})"), any);
  columns.add(Json::parse(R"({"a": 1, "b": 2, "d": 3, "e": 4})"), any);
  EXPECT_EQ(columns.keys(), (Keys{"a", "b", "c", "d", "e"}));
}

TEST(CorpusColumnsTest, AnotherOrderAddsNoKeyTwice) {
  CorpusColumns columns;
  columns.add(Json::parse(R"({"a": 1, "b": 2})"), any);
  columns.add(Json::parse(R"({"b": 1, "a": 2})"), any);
  EXPECT_EQ(columns.keys(), (Keys{"a", "b"}));
}

TEST(CorpusColumnsTest, WhatIsNotWantedHasNoColumn) {
  CorpusColumns columns;
  columns.add(Json::parse(R"({"a": [1], "b": {"x": 1}, "c": null})"), single);
  EXPECT_EQ(columns.keys(), Keys{"c"});
}

TEST(CorpusColumnsTest, ThereAreBounds) {
  Json object;
  for (int i = 0; i < 5000; ++i) object[std::to_string(i)] = i;
  CorpusColumns columns;
  columns.add(object, any);
  EXPECT_EQ(columns.keys().size(), CorpusColumns::kMost);
}

}  // namespace
}  // namespace atlasgauge
