#include "stream/seams/null_charts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

TEST(NullChartsTest, CandidatesAreDroppedByEitherFaceForAnyBudget) {
  // Every third of 200000 faces is in a null chart; with 16 KiB their bits take several passes.
  for (const std::uint64_t kib : {16, 4096}) {
    TestEngine engine({.budget_bytes = kib << 10});
    std::vector<FaceId> null_faces;
    for (std::uint32_t i = 0; i < 200000; i += 3) null_faces.push_back(FaceId{i});
    std::vector<SeamCandidate> candidates;
    for (std::uint32_t i = 0; i < 10000; ++i) {
      SeamCandidate seam{};
      seam.faces[0] = FaceId{i * 13 % 200000};
      seam.faces[1] = FaceId{i * 17 % 200000};
      seam.length_3d = 1.0 + i;
      candidates.push_back(seam);
    }
    std::vector<double> expected;
    for (const SeamCandidate& seam : candidates) {
      if (raw(seam.faces[0]) % 3 != 0 && raw(seam.faces[1]) % 3 != 0)
        expected.push_back(seam.length_3d);
    }
    std::vector<double> found;
    for (const SeamCandidate& seam : records_of(drop_null_charts(
             engine, spill_of(engine, candidates), spill_of(engine, null_faces), 200000))) {
      found.push_back(seam.length_3d);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace atlasgauge
