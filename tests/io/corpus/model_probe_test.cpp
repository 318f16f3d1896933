#include "io/corpus/model_probe.hpp"

#include <gtest/gtest.h>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

const ModelProbe kProbe{"a\tb.obj", 1.5, {"00ff", 13, {{"/c/a\tb.obj", 10, -5}, {"/c/x", 3, 7}}}};

TEST(ModelProbeTest, ComesBackFromText) {
  const auto probes = read_probes(probe_text(kProbe) + probe_text({"b.obj", 0, {"01", 0, {}}}));
  ASSERT_EQ(probes.size(), 2U);
  EXPECT_EQ(probes[0].path, "a\tb.obj");
  EXPECT_EQ(probes[0].seconds, 1.5);
  EXPECT_EQ(probes[0].inputs.hex, "00ff");
  EXPECT_EQ(probes[0].inputs.bytes, 13U);
  ASSERT_EQ(probes[0].inputs.files.size(), 2U);
  EXPECT_EQ(probes[0].inputs.files[0].path, "/c/a\tb.obj");
  EXPECT_EQ(probes[0].inputs.files[0].modified_ns, -5);
  EXPECT_EQ(probes[1].path, "b.obj");
  EXPECT_TRUE(probes[1].inputs.files.empty());
}

TEST(ModelProbeTest, OfATextThatIsCutOnlyWhatEndedCounts) {
  const std::string text = probe_text(kProbe);
  for (std::size_t bytes = 0; bytes < text.size(); ++bytes) {
    EXPECT_TRUE(read_probes(text.substr(0, bytes)).empty()) << bytes;
  }
  EXPECT_EQ(read_probes(text).size(), 1U);
}

TEST(ModelProbeTest, AnotherTextIsAFault) {
  EXPECT_THROW(read_probes("hello\n"), Error);
  EXPECT_THROW(read_probes("file\tx\t1\tp\n"), Error);
  EXPECT_THROW(read_probes("model\t1\t2\n"), Error);
}

}  // namespace
}  // namespace atlasgauge
