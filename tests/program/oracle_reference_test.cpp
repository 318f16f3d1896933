// The oracle against reports of real models, made by other means: whom to believe when it and the
// program differ.

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <vector>

#include "io/image/image_module.hpp"
#include "io/image/image_reader.hpp"
#include "tests/support/module_folder.hpp"
#include "tests/support/oracle_comparison.hpp"
#include "tests/support/reference_reports.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

/// From the words "-t", "WxH".
std::optional<ImageSize> size_option(const std::vector<std::string>& options) {
  if (options.size() != 2) return std::nullopt;
  const std::string& text = options[1];
  ImageSize size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  std::from_chars(width.ptr + 1, end, size.height);
  return size;
}

/// The plain way takes from 2 to 26 seconds for them.
const std::vector<std::string> kTooSlow = {
    "bullet3/data/dinnerware/cup/Cup/textured-0008192.obj",
    "derived/nasa_tiles_leaves/nasa_leaves.obj",
    "meshroom/esp32cam/texturedMesh.obj",
    "prl_assets/pocky_box/pocky_box_visual.obj",
};

bool is_too_slow(const ReferenceReport& reference) {
  return std::find(kTooSlow.begin(), kTooSlow.end(), reference.name) != kTooSlow.end();
}

TEST(OracleReferenceTest, SmallRealModelsAgree) {
  show_modules(kImageModuleFile);
  std::vector<ReferenceReport> list = reference_reports();
  if (list.empty()) GTEST_SKIP() << "SKIPPED: no reference reports beside this checkout";
  std::erase_if(list, is_too_slow);
  const TempDir dir;
  for (const ReferenceReport& reference : list) {
    SCOPED_TRACE(reference.name);
    PipelineConfig config;
    config.probe = read_image_header;
    config.open_image = open_image;
    config.texture_size = size_option(reference.options);
    const Outcome oracle = oracle_outcome(reference.model.string(), config);
    ASSERT_TRUE(oracle.report) << oracle.refusal;
    const std::vector<std::string> differences =
        reference_differences(dir.write("report.json", oracle.report->dump()), reference);
    EXPECT_EQ(differences, std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace atlasgauge
