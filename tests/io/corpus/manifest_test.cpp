#include "io/corpus/manifest.hpp"

#include <gtest/gtest.h>

#include "tests/support/input_error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

class ManifestTest : public testing::Test {
 protected:
  ManifestTest() { job_.make_folders(); }

  void write_model_line(const std::string& line) const {
    dir_.write("manifest.tsv", line);
    dir_.write("inputs.tsv", "");
  }

  TempDir dir_;
  CorpusJob job_{dir_.path().string()};
};

TEST_F(ManifestTest, ModelsComeBackWithTheirInputs) {
  ManifestWriter writer(job_);
  writer.add_input({"/c/a\n.obj", 10, -5});
  writer.add_input({"/c/a.mtl", 3, 7});
  writer.add_input({"/c/b.obj", 1, 2});
  writer.add_model({4, 1.5, 13, 2, "00ff", "a\n.obj"});
  writer.add_model({0, 0.25, 1, 1, "01ff", "b.obj"});
  writer.commit();
  ManifestReader reader(job_);
  const auto a = reader.next();
  ASSERT_TRUE(a);
  EXPECT_EQ(a->slice, 4U);
  EXPECT_EQ(a->seconds, 1.5);
  EXPECT_EQ(a->bytes, 13U);
  EXPECT_EQ(a->digest, "00ff");
  EXPECT_EQ(a->path, "a\n.obj");
  ASSERT_EQ(reader.inputs().size(), 2U);
  EXPECT_EQ(reader.inputs()[0].path, "/c/a\n.obj");
  EXPECT_EQ(reader.inputs()[0].bytes, 10U);
  EXPECT_EQ(reader.inputs()[0].modified_ns, -5);
  ASSERT_TRUE(reader.next());
  ASSERT_EQ(reader.inputs().size(), 1U);
  EXPECT_EQ(reader.inputs()[0].path, "/c/b.obj");
  EXPECT_FALSE(reader.next());
}

TEST_F(ManifestTest, PathsThatLeadOutOfTheCorpusAreRefused) {
  for (const char* path : {"../a.obj", "b/../../a.obj", "/a.obj", ""}) {
    write_model_line(std::string("0\t1\t1\t0\tff\t") + path + "\n");
    EXPECT_TRUE(says(input_error_of([&] { ManifestReader(job_).next(); }), "not a path below"));
  }
}

TEST_F(ManifestTest, AManifestWithMoreModelsThanInputsIsRefused) {
  write_model_line("0\t1\t1\t3\tff\ta.obj\n");
  EXPECT_TRUE(says(input_error_of([&] { ManifestReader(job_).next(); }), "inputs of all models"));
}

TEST_F(ManifestTest, GarbageIsRefusedWithItsLine) {
  write_model_line("#x\n0\t1\t1\t0\tff\ta.obj\nwhat\n");
  ManifestReader reader(job_);
  ASSERT_TRUE(reader.next());
  EXPECT_TRUE(says(input_error_of([&] { reader.next(); }), "manifest.tsv:3: "));
}

TEST_F(ManifestTest, SettingsComeBack) {
  job_.write_settings({"/corpus of\tmine", 7, {"-t", "64x64", "--strict"}});
  const CorpusSettings settings = job_.read_settings();
  EXPECT_EQ(settings.root, "/corpus of\tmine");
  EXPECT_EQ(settings.slices, 7U);
  EXPECT_EQ(settings.arguments, (std::vector<std::string>{"-t", "64x64", "--strict"}));
}

TEST_F(ManifestTest, AFolderWithoutAJobIsNamed) {
  EXPECT_TRUE(says(input_error_of([&] { job_.read_settings(); }), "not the folder of a job"));
}

}  // namespace
}  // namespace atlasgauge
