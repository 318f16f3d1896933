// The files of seam edges, as a user asks for them.

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "measures/output/seam_file.hpp"
#include "tests/support/engine_fixture.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using nlohmann::json;

/// Seam edges from a list.
class ListedSeams : public SeamRows {
 public:
  explicit ListedSeams(std::vector<LocatedSeam> seams) : seams_(std::move(seams)) {}
  std::uint64_t count() const override { return seams_.size(); }
  bool read(LocatedSeam& seam) override {
    if (next_ == seams_.size()) return false;
    seam = seams_[next_++];
    return true;
  }

 private:
  std::vector<LocatedSeam> seams_;
  std::size_t next_ = 0;
};

/// One with samples, one that is too short, and one between a face without UVs and one without a
/// texture.
std::vector<LocatedSeam> three_seams() {
  LocatedSeam measured{{}, {{0, 0.5, 1}, {3, 4.5, 1}}};
  measured.edge.length_3d = 5;
  measured.edge.sampled = true;
  measured.edge.samples = 40;
  measured.edge.discrepancy = 16;
  measured.edge.texmetro_discrepancy = 55.5;
  measured.edge.sides[0] = {SlotId{0}, {{0.1F, 0.2F}, {0.5F, 0.75F}}};
  measured.edge.sides[1] = {SlotId{2}, {{1, -1}, {0, 3}}};
  LocatedSeam too_short = measured;
  too_short.edge.samples = 0;
  too_short.edge.discrepancy = too_short.edge.texmetro_discrepancy =
      std::numeric_limits<double>::quiet_NaN();
  LocatedSeam unsampled = too_short;
  unsampled.edge.sampled = false;
  unsampled.edge.sides[0].t[0] = unsampled.edge.sides[0].t[1] = kNoTexCoord;
  unsampled.edge.sides[1].slot = kNone<SlotId>;
  return {measured, too_short, unsampled};
}

class SeamTableTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (dir_.path() / name).string(); }

  std::string written(const std::string& name, std::vector<LocatedSeam> seams,
                      bool texmetro = false) {
    ListedSeams rows(std::move(seams));
    const auto file = open_seam_file(path(name), texmetro, engine_);
    file->write(rows);
    file->commit();
    return content_of(path(name));
  }

  TempDir dir_;
  TestEngine engine_;
};

TEST_F(SeamTableTest, CsvHasARowForEachSeamEdge) {
  EXPECT_EQ(written("t.csv", three_seams()),
            "x0,y0,z0,x1,y1,z1,length_3d,texture_a,u0_a,v0_a,u1_a,v1_a,texture_b,u0_b,v0_b,u1_b,"
            "v1_b,samples,discrepancy\n"
            "0.0,0.5,1.0,3.0,4.5,1.0,5.0,0,0.1,0.2,0.5,0.75,2,1.0,-1.0,0.0,3.0,40,16.0\n"
            "0.0,0.5,1.0,3.0,4.5,1.0,5.0,0,0.1,0.2,0.5,0.75,2,1.0,-1.0,0.0,3.0,0,\n"
            "0.0,0.5,1.0,3.0,4.5,1.0,5.0,0,,,,,,1.0,-1.0,0.0,3.0,,\n");
}

TEST_F(SeamTableTest, JsonLinesSayTheSameWithNullForWhatIsMissing) {
  std::istringstream lines(written("t.jsonl", three_seams()));
  std::vector<json> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(json::parse(line));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0], json::parse(R"({"x0": 0.0, "y0": 0.5, "z0": 1.0, "x1": 3.0, "y1": 4.5,
      "z1": 1.0, "length_3d": 5.0, "texture_a": 0, "u0_a": 0.1, "v0_a": 0.2, "u1_a": 0.5,
      "v1_a": 0.75, "texture_b": 2, "u0_b": 1.0, "v0_b": -1.0, "u1_b": 0.0, "v1_b": 3.0,
      "samples": 40, "discrepancy": 16.0})"));
  EXPECT_EQ(rows[1].at("samples"), 0);
  for (const char* key : {"u0_a", "v1_a", "texture_b", "samples", "discrepancy"}) {
    EXPECT_TRUE(rows[2].at(key).is_null()) << key;
  }
}

TEST_F(SeamTableTest, TexmetroIsALastColumnIfAskedFor) {
  std::istringstream lines(written("t.csv", three_seams(), true));
  std::vector<std::string> ends;
  for (std::string line; std::getline(lines, line);) {
    ends.push_back(line.substr(line.rfind(',', line.rfind(',') - 1)));
  }
  EXPECT_EQ(ends, (std::vector<std::string>{",discrepancy,texmetro_discrepancy", ",16.0,55.5", ",,",
                                            ",,"}));
}

/// What lies behind the header.
std::string body(const std::string& ply) {
  const std::string end = "end_header\n";
  return ply.substr(ply.find(end) + end.size());
}

constexpr std::size_t kVertexBytes = 35, kEdgeBytes = 11;

double value_at(const std::string& bytes, std::size_t at) {
  double value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::vector<int> color_at(const std::string& bytes, std::size_t at) {
  std::vector<int> color;
  for (std::size_t i = 0; i < 3; ++i) color.push_back(static_cast<std::uint8_t>(bytes.at(at + i)));
  return color;
}

TEST_F(SeamTableTest, PlyHasColoursByDiscrepancyAndGreyForNone) {
  const std::string ply = written("t.ply", three_seams());
  EXPECT_NE(ply.find("element vertex 6\n"), std::string::npos);
  EXPECT_NE(ply.find("property double discrepancy\n"), std::string::npos);
  const std::string bytes = body(ply);
  ASSERT_EQ(bytes.size(), 6 * kVertexBytes + 3 * kEdgeBytes);
  const std::vector<int> green{0, 176, 0}, grey{128, 128, 128};
  const std::vector<std::vector<int>> colors{green, grey, grey};
  const std::vector<double> values{16, -1, -1};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(color_at(bytes, 2 * i * kVertexBytes + 24), colors[i]);
    EXPECT_EQ(value_at(bytes, 2 * i * kVertexBytes + 27), values[i]);
    EXPECT_EQ(value_at(bytes, (2 * i + 1) * kVertexBytes), 3) << "x of the other end";
    EXPECT_EQ(color_at(bytes, 6 * kVertexBytes + i * kEdgeBytes + 8), colors[i]);
  }
}

TEST_F(SeamTableTest, ColoursOfManyEdgesPassThroughScratch) {
  std::vector<LocatedSeam> seams;
  constexpr std::size_t kSeams = 10'000;  // several blocks of colours
  for (std::size_t i = 0; i < kSeams; ++i) {
    seams.push_back(three_seams()[0]);
    seams.back().edge.discrepancy = static_cast<double>(i % 64);
  }
  const std::string bytes = body(written("t.ply", seams));
  ASSERT_EQ(bytes.size(), kSeams * (2 * kVertexBytes + kEdgeBytes));
  for (std::size_t i = 0; i < kSeams; ++i) {
    EXPECT_EQ(color_at(bytes, 2 * kSeams * kVertexBytes + i * kEdgeBytes + 8),
              color_at(bytes, 2 * i * kVertexBytes + 24));
  }
  EXPECT_GT(engine_.scratch.written_bytes(), 0U);
}

TEST_F(SeamTableTest, PlyIsWrittenWhenTheRowsTookAllMemory) {
  const auto file = open_seam_file(path("t.ply"), false, engine_);
  const Reservation rest = engine_.budget.reserve(engine_.budget.free_bytes(), "rows");
  ListedSeams rows(three_seams());
  file->write(rows);
  file->commit();
  EXPECT_FALSE(content_of(path("t.ply")).empty());
}

TEST_F(SeamTableTest, UnwritableTargetIsFoundBeforeTheWork) {
  for (const char* name : {"none/t.csv", "none/t.ply"}) {
    EXPECT_THROW(open_seam_file(path(name), false, engine_), Error) << name;
  }
}

TEST_F(SeamTableTest, UnknownSuffixExitsWithTwoBeforeTheModelIsOpened) {
  const ProgramResult result =
      run_program(ATLASGAUGE_PROGRAM, {path("none.obj"), "-q", "--seams", path("t.txt")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("t.txt"), std::string::npos) << result.err;
}

TEST_F(SeamTableTest, FailedRunLeavesNoFileAndAnOldOneAsItWas) {
  const std::string model = dir_.write("bad.obj", "v 0 0 0\nv 1 x 0\n");
  for (const std::string name : {"t.csv", "t.ply"}) {
    const std::vector<std::string> arguments{model, "-q", "--seams", path(name)};
    EXPECT_EQ(run_program(ATLASGAUGE_PROGRAM, arguments).exit_code, 3);
    EXPECT_FALSE(std::filesystem::exists(path(name)));
    dir_.write(name, "old");
    EXPECT_EQ(run_program(ATLASGAUGE_PROGRAM, arguments).exit_code, 3);
    EXPECT_EQ(content_of(path(name)), "old");
  }
}

}  // namespace
}  // namespace atlasgauge
