#include "bench/end_to_end/site_plan.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "bench/site.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

TEST(SitePlanTest, SiteHasAboutTheBytesItWasPlannedFor) {
  for (const double bytes : {5e5, 8e6}) {
    const TempDir folder;
    SiteOptions options;
    options.faces = faces_of_obj(bytes);
    options.image_format = ImageFormat::kNone;
    write_site(Site(options), folder.path().string());
    const auto made = static_cast<double>(std::filesystem::file_size(folder.path() / "site.obj"));
    EXPECT_NEAR(made / bytes, 1, 0.1) << options.faces;
  }
}

TEST(SitePlanTest, FacesTakeMoreBytesWithLongerIndices) {
  EXPECT_NEAR(obj_bytes_a_face(1e6), 72, 1);    // 72 MB, measured
  EXPECT_NEAR(obj_bytes_a_face(1e8), 85, 1.5);  // 8.5 GB
}

TEST(SitePlanTest, TexturesGrowWithTheFacesAndFillARectangle) {
  EXPECT_EQ(textures_for(1000, 1024), 1U);
  EXPECT_EQ(textures_for(1'048'576, 1024), 8U);   // 2 x 4
  EXPECT_EQ(textures_for(917'504, 1024), 8U);     // 7 would be one row
  EXPECT_EQ(textures_for(1'310'720, 1024), 12U);  // 3 x 4 for 10
}

TEST(SitePlanTest, ImagesCountOnDisk) {
  SitePlan site;
  site.faces = 1000;
  site.obj_bytes = 72'000;
  site.texture_format = "none";
  const std::uint64_t bare = site.disk_bytes();
  EXPECT_GE(bare, 72'000U + 260'000U);
  site.texture_format = "png";
  site.textures = 2;
  site.texture_size_texels = 1024;
  EXPECT_GE(site.disk_bytes(), bare + 2 * 3 * 1024 * 1024);
}

}  // namespace
}  // namespace atlasgauge
