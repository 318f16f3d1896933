#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "measures/base/measure.hpp"
#include "tests/measures/random_groups.hpp"

namespace atlasgauge {
namespace {

using Partial = std::unique_ptr<AnyMeasure>;

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const Partial& measure : all_measures()) names.emplace_back(measure->name());
  return names;
}

std::string report_of(const AnyMeasure& measure) {
  Report report;
  const MeshFacts facts = any_facts();
  measure.finish(facts, report);
  return report.to_json().dump(1);
}

std::vector<std::byte> saved(AnyMeasure& measure) {
  Saver saver;
  measure.save(saver);
  return saver.bytes();
}

/// Every group goes to any of the parts.
std::vector<Groups> cut(const Groups& whole, std::size_t parts, unsigned seed) {
  std::vector<Groups> cut_up(parts);
  std::mt19937 random(seed);
  const auto deal = [&](auto Groups::*kind) {
    for (const auto& group : whole.*kind) (cut_up[random() % parts].*kind).push_back(group);
  };
  deal(&Groups::triangles);
  deal(&Groups::raw_edges);
  deal(&Groups::uv_edges);
  deal(&Groups::seam_edges);
  deal(&Groups::stars);
  deal(&Groups::components);
  deal(&Groups::charts);
  deal(&Groups::cracks);
  deal(&Groups::levels);
  return cut_up;
}

/// One partial has seen it all.
class MeasureLawsTest : public testing::TestWithParam<std::string> {
 protected:
  MeasureLawsTest() { feed(*whole_, groups_); }

  static Partial fresh() {
    for (Partial& measure : all_measures()) {
      if (measure->name() == GetParam()) return std::move(measure);
    }
    return nullptr;
  }
  static Partial reloaded(AnyMeasure& measure) {
    const std::vector<std::byte> bytes = saved(measure);
    Loader loader(bytes);
    Partial loaded = fresh();
    loaded->load(loader);
    return loaded;
  }

  const Groups groups_ = RandomGroups(1).some(700);
  const Partial whole_ = fresh();
};
INSTANTIATE_TEST_SUITE_P(Every, MeasureLawsTest, testing::ValuesIn(all_names()),
                         [](const auto& name) { return name.param; });

TEST_P(MeasureLawsTest, MergedPartsAreTheWhole) {
  for (std::size_t parts = 1; parts <= 7; ++parts) {
    std::vector<Partial> partials;
    for (const Groups& part : cut(groups_, parts, static_cast<unsigned>(parts))) {
      feed(*partials.emplace_back(fresh()), part);
    }
    std::shuffle(partials.begin(), partials.end(), std::mt19937(static_cast<unsigned>(parts)));
    while (partials.size() > 1) {
      // The last into any other: trees of merges of every shape.
      const std::size_t into = partials.size() * 7 % (partials.size() - 1);
      partials[into]->merge(*partials.back());
      partials.pop_back();
    }
    EXPECT_EQ(report_of(*partials[0]), report_of(*whole_)) << parts << " parts";
  }
}

TEST_P(MeasureLawsTest, OrderOfGroupsDoesNotMatter) {
  Groups shuffled = groups_;
  const auto shuffle = [](auto& list) { std::shuffle(list.begin(), list.end(), std::mt19937(3)); };
  shuffle(shuffled.triangles);
  shuffle(shuffled.raw_edges);
  shuffle(shuffled.uv_edges);
  shuffle(shuffled.seam_edges);
  shuffle(shuffled.stars);
  shuffle(shuffled.components);
  shuffle(shuffled.charts);
  shuffle(shuffled.cracks);
  shuffle(shuffled.levels);
  const Partial measure = fresh();
  feed(*measure, shuffled);
  EXPECT_EQ(report_of(*measure), report_of(*whole_));
}

TEST_P(MeasureLawsTest, FreshPartialChangesNothing) {
  const std::string before = report_of(*whole_);
  whole_->merge(*fresh());
  EXPECT_EQ(report_of(*whole_), before);
  const Partial empty = fresh();
  empty->merge(*whole_);
  EXPECT_EQ(report_of(*empty), before);
}

TEST_P(MeasureLawsTest, SavedAndLoadedIsTheSame) {
  const Partial loaded = reloaded(*whole_);
  EXPECT_EQ(report_of(*loaded), report_of(*whole_));
  EXPECT_EQ(saved(*loaded), saved(*whole_));
}

TEST_P(MeasureLawsTest, SavedHalfWayGoesOn) {
  const std::vector<Groups> parts = cut(groups_, 3, 9);
  Partial measure = fresh();
  for (const Groups& part : parts) {
    feed(*measure, part);
    measure = reloaded(*measure);
  }
  EXPECT_EQ(report_of(*measure), report_of(*whole_));
}

TEST_P(MeasureLawsTest, LoadingReplacesWhatWasThere) {
  const Partial empty = fresh();
  const std::vector<std::byte> bytes = saved(*empty);
  Loader loader(bytes);
  whole_->load(loader);
  EXPECT_EQ(report_of(*whole_), report_of(*fresh()));
}

TEST_P(MeasureLawsTest, StateDoesNotGrow) {
  constexpr std::size_t kBoundBytes = 4096;
  const std::size_t size_at_first = saved(*fresh()).size();
  EXPECT_LE(size_at_first, kBoundBytes);
  EXPECT_EQ(saved(*whole_).size(), size_at_first);
  for (unsigned seed = 0; seed < 10; ++seed) feed(*whole_, RandomGroups(seed).some(700));
  EXPECT_EQ(saved(*whole_).size(), size_at_first);
}

TEST_P(MeasureLawsTest, CutShortIsAnError) {
  const std::vector<std::byte> bytes = saved(*whole_);
  Loader loader({bytes.data(), bytes.size() - 1});
  EXPECT_THROW(fresh()->load(loader), Error);
}

TEST_P(MeasureLawsTest, FreshIsEmptyWhateverItIsMadeFrom) {
  EXPECT_EQ(report_of(*whole_->fresh()), report_of(*fresh()));
}

TEST(AllMeasuresTest, AreThoseThatRegisterByName) {
  EXPECT_EQ(all_names(),
            (std::vector<std::string>{"angle_min", "chart_area", "charts", "crumbliness",
                                      "distortion", "edges", "mapped_fraction", "mesh_size",
                                      "quantization", "scaling", "seams", "texel_density",
                                      "texel_overlap", "texture_use", "topology", "worst_seams"}));
}

TEST(AllMeasuresTest, NoTwoSetTheSameKey) {
  std::vector<std::string> keys;
  for (const Partial& measure : all_measures()) {
    Report report, none;
    const MeshFacts facts = any_facts();
    measure->finish(facts, report);
    const Json json = report.to_json(), empty = none.to_json();
    for (const auto& [key, value] : json.items()) {
      if (!value.is_null() && (!empty.contains(key) || empty.at(key) != value)) keys.push_back(key);
    }
  }
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
}

}  // namespace
}  // namespace atlasgauge
