#include "bench/site_texels.hpp"

#include <gtest/gtest.h>

namespace atlasgauge {
namespace {

void expect_counts(const TexelCounts& counts, const TexelCounts& want) {
  EXPECT_EQ(counts.covered, want.covered);
  EXPECT_EQ(counts.bilinear, want.bilinear);
  EXPECT_EQ(counts.boundary, want.boundary);
  EXPECT_EQ(counts.clashes, want.clashes);
}

TEST(SiteTexelsTest, NothingCoversNothing) {
  expect_counts(count_texels({}, 8), {});
  expect_counts(count_texels({{3, 3, 2, 5}, {2, 5, 3, 3}}, 8), {});
}

TEST(SiteTexelsTest, RectangleHasABorderAndAHem) {
  expect_counts(count_texels({{2, 6, 3, 6}}, 8), {.covered = 12, .bilinear = 30, .boundary = 10});
}

TEST(SiteTexelsTest, HemEndsAtTheRimAndTheRimIsBorder) {
  expect_counts(count_texels({{0, 4, 0, 4}}, 4), {.covered = 16, .bilinear = 16, .boundary = 12});
  expect_counts(count_texels({{0, 1, 0, 1}}, 4), {.covered = 1, .bilinear = 4, .boundary = 1});
}

TEST(SiteTexelsTest, NeighboursClashAndCloseTheBorderBetweenThem) {
  expect_counts(count_texels({{1, 3, 1, 5}, {3, 5, 1, 5}}, 6),
                {.covered = 16, .bilinear = 36, .boundary = 12, .clashes = 8});
  expect_counts(count_texels({{1, 5, 1, 3}, {1, 5, 3, 5}}, 6),
                {.covered = 16, .bilinear = 36, .boundary = 12, .clashes = 8});
}

TEST(SiteTexelsTest, CornersClash) {
  expect_counts(count_texels({{0, 2, 0, 2}, {2, 4, 2, 4}}, 4),
                {.covered = 8, .bilinear = 14, .boundary = 8, .clashes = 2});
}

TEST(SiteTexelsTest, ATexelBetweenIsNoClash) {
  expect_counts(count_texels({{0, 1, 0, 1}, {2, 3, 0, 1}}, 4),
                {.covered = 2, .bilinear = 8, .boundary = 2});
}

}  // namespace
}  // namespace atlasgauge
