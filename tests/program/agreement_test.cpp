#include "tests/support/agreement.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace atlasgauge {
namespace {

using nlohmann::json;

json seam(double discrepancy, double x, double u = 0.5) {
  return {{"discrepancy", discrepancy},
          {"from", {x, 0, 0}},
          {"sides", json::array({{{"uv_from", {u, 0}}, {"uv_to", {1, 0}}}})}};
}

/// A list in braces would be copied where it has one item.
using List = std::vector<json>;

constexpr double kBitMore = 10 + 1e-13;

TEST(AgreementTest, ListsAreComparedItemByItem) {
  EXPECT_TRUE(agree({1, {{"a", 2.0}}}, {1, {{"a", 2.0 + 1e-13}}}, 0));
  EXPECT_FALSE(agree({1, {{"a", 2.0}}}, {1, {{"a", 2.1}}}, 0));
  EXPECT_FALSE(agree({1, {{"a", 2.0}}}, {1, {{"b", 2.0}}}, 0));
  EXPECT_FALSE(agree(json::array({1.0}), json::array({1.0, 2.0}), 0));
  EXPECT_FALSE(agree({1.0, nullptr}, {1.0, 0.0}, 0));
}

TEST(AgreementTest, SeamsOfEqualDiscrepancyHaveAnOrder) {
  EXPECT_TRUE(worst_seams_agree(List{seam(10, 1), seam(10, 2)}, List{seam(10, 1), seam(10, 2)}));
  EXPECT_FALSE(worst_seams_agree(List{seam(10, 2), seam(10, 1)}, List{seam(10, 1), seam(10, 2)}));
}

TEST(AgreementTest, SeamsThatRoundingTellsApartHaveNone) {
  EXPECT_TRUE(
      worst_seams_agree(List{seam(kBitMore, 2), seam(10, 1)}, List{seam(10, 1), seam(10, 2)}));
  EXPECT_FALSE(
      worst_seams_agree(List{seam(kBitMore, 3), seam(10, 1)}, List{seam(10, 1), seam(10, 2)}));
}

TEST(AgreementTest, SeamsOfOtherPlacesOrHeightsContradict) {
  EXPECT_FALSE(worst_seams_agree(List{seam(10, 1)}, List{seam(11, 1)}));
  EXPECT_FALSE(worst_seams_agree(List{seam(10, 1)}, List{seam(10, 2)}));
  EXPECT_FALSE(worst_seams_agree(List{seam(10, 1)}, List{}));
  EXPECT_FALSE(worst_seams_agree(nullptr, List{}));
}

TEST(AgreementTest, UvsOfSeamsAreFloatsInAnyDigits) {
  EXPECT_TRUE(worst_seams_agree(List{seam(10, 1, 0.1)}, List{seam(10, 1, double{0.1F})}));
  EXPECT_FALSE(worst_seams_agree(List{seam(10, 1, 0.1)}, List{seam(10, 1, 0.1000001)}));
}

// Which seams are the last of twenty may hang on rounding.
TEST(AgreementTest, EndOfAFullListMayBeOtherSeamsOfThatHeight) {
  List list(18, seam(20, 1));
  List other = list;
  list.insert(list.end(), {seam(kBitMore, 1), seam(10, 2)});
  other.insert(other.end(), {seam(kBitMore, 3), seam(10, 1)});
  EXPECT_TRUE(worst_seams_agree(list, other));
  list.pop_back();
  other.pop_back();
  EXPECT_FALSE(worst_seams_agree(list, other));
}

}  // namespace
}  // namespace atlasgauge
