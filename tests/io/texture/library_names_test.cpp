#include "io/texture/library_names.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace atlasgauge {
namespace {

using Names = std::vector<std::string>;

LibraryNames split(const std::string& text, const std::set<std::string>& files) {
  return split_library_names(text, [&](const std::string& name) { return files.contains(name); });
}

TEST(LibraryNamesTest, TheWholeTextIsOneNameIfItExists) {
  EXPECT_EQ(split("a b.mtl", {"a b.mtl", "a", "b.mtl"}).found, Names{"a b.mtl"});
}

TEST(LibraryNamesTest, TheLongestRunsOfWordsThatExistAreNames) {
  const LibraryNames names =
      split("box green.mtl box blue.mtl box", {"box green.mtl", "box blue.mtl", "box"});
  EXPECT_EQ(names.found, (Names{"box green.mtl", "box blue.mtl", "box"}));
  EXPECT_TRUE(names.missing.empty());
}

TEST(LibraryNamesTest, WordsBetweenAreMissing) {
  const LibraryNames names = split("x.mtl y z.mtl\ta.mtl  w.mtl", {"a.mtl"});
  EXPECT_EQ(names.found, Names{"a.mtl"});
  EXPECT_EQ(names.missing, (Names{"x.mtl y z.mtl", "w.mtl"}));
}

TEST(LibraryNamesTest, NamesMayStandInQuotes) {
  EXPECT_EQ(split("\"a b.mtl\" c.mtl", {"a b.mtl", "c.mtl"}).found, (Names{"a b.mtl", "c.mtl"}));
}

TEST(LibraryNamesTest, SpacesMayBeEscaped) {
  EXPECT_EQ(split("no.mtl a\\ b\\ c.mtl", {"a b c.mtl"}).found, Names{"a b c.mtl"});
}

TEST(LibraryNamesTest, BackslashesCountAsSlashes) {
  EXPECT_EQ(split("lib\\a.mtl", {"lib/a.mtl"}).found, Names{"lib/a.mtl"});
}

TEST(LibraryNamesTest, NothingNamesNothing) {
  EXPECT_TRUE(split("", {}).found.empty());
  EXPECT_TRUE(split("  ", {}).missing.empty());
}

TEST(LibraryNamesTest, ManyMissingWordsAreLookedUpABoundedNumberOfTimes) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += "w ";
  std::size_t look_ups = 0;
  split_library_names(text, [&](const std::string&) {
    ++look_ups;
    return false;
  });
  EXPECT_LT(look_ups, 5000U * 64 * 3 + 10);
}

}  // namespace
}  // namespace atlasgauge
