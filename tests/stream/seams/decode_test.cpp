#include "stream/seams/decode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "io/warnings.hpp"
#include "tests/stream/seams/memory_textures.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

/// Counts how often images are opened, and how many are open at a time.
class OpenCount {
 public:
  OpenImage counting(const OpenImage& open) {
    return [this, open](const ImageSource& image) -> std::unique_ptr<ImageRows> {
      {
        const std::lock_guard lock(mutex_);
        ++opened[image.path];
        most_at_a_time = std::max(most_at_a_time, ++now_);
      }
      return std::make_unique<Rows>(*this, open(image));
    };
  }

  std::map<std::string, int> opened;
  int most_at_a_time = 0;

 private:
  class Rows : public ImageRows {
   public:
    Rows(OpenCount& count, std::unique_ptr<ImageRows> rows)
        : count_(count), rows_(std::move(rows)) {}
    ~Rows() override {
      const std::lock_guard lock(count_.mutex_);
      --count_.now_;
    }
    const ImageHeader& header() const override { return rows_->header(); }
    void read(std::uint32_t rows, std::byte* to) override { rows_->read(rows, to); }

   private:
    OpenCount& count_;
    std::unique_ptr<ImageRows> rows_;
  };

  std::mutex mutex_;
  int now_ = 0;
};

class DecodeTest : public testing::Test {
 protected:
  DecodePlan plan() {
    return {.model = "model.obj",
            .open_image = count_.counting(textures_.open()),
            .spare_bytes = spare_bytes_};
  }

  /// What the refusal says, if there is one.
  std::string refusal(const EngineOptions& options) {
    TestEngine engine(options);
    try {
      require_room_for_images(engine, textures_.slots(), plan());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kResource);
      EXPECT_TRUE(count_.opened.empty());
      return error.what();
    }
    EXPECT_EQ(engine.budget.free_bytes(), options.budget_bytes);
    return "";
  }

  TexelStore decode(const Engine& engine) {
    Warnings warnings([&](const std::string& text) { warned_.push_back(text); });
    return decode_images(engine, textures_.slots(), std::vector<bool>(textures_.size(), true),
                         plan(), warnings);
  }

  MemoryTextures textures_;
  OpenCount count_;
  std::uint64_t spare_bytes_ = 0;
  std::vector<std::string> warned_;
};

TEST_F(DecodeTest, ImageThatNeedsMoreThanTheBudgetIsRefusedByName) {
  textures_.add(distinct_texels({8, 8}, TexelKind::kByte));
  textures_.add(distinct_texels({900, 500}, TexelKind::kByte, 30 * kMiB));
  EXPECT_EQ(refusal({.budget_bytes = 40 * kMiB}), "");
  const std::string text = refusal({.budget_bytes = 20 * kMiB});
  // The need is 30 MiB, a band of 900 x 64 texels, a tile and a block.
  EXPECT_EQ(text.find("image1: decoding this image (900 x 500 texels) takes 30.2 MiB of memory, "
                      "which is 10.2 MiB more than there is; raise --memory by "),
            0U)
      << text;
}

TEST_F(DecodeTest, BandOfAWideImageCounts) {
  textures_.add(distinct_texels({100'000, 64}, TexelKind::kFloat));  // 73 MiB
  EXPECT_NE(refusal({.budget_bytes = 73 * kMiB}), "");
  EXPECT_EQ(refusal({.budget_bytes = 74 * kMiB}), "");
}

TEST_F(DecodeTest, SpareMemoryIsUsedBeforeTheBudget) {
  textures_.add(distinct_texels({100, 100}, TexelKind::kByte, 30 * kMiB));
  spare_bytes_ = 11 * kMiB;
  EXPECT_EQ(refusal({.budget_bytes = 20 * kMiB}), "");
  spare_bytes_ = 100 * kMiB;
  EXPECT_EQ(refusal({.budget_bytes = 2 * kMiB}), "");
  TestEngine engine({.budget_bytes = 2 * kMiB, .workers = 3});
  EXPECT_TRUE(decode(engine).image(SlotId{0}).decoded);
  EXPECT_EQ(engine.budget.peak_bytes(), 0U);
}

TEST_F(DecodeTest, ImagesThatNoFaceNamesNeedNothing) {
  textures_.add(distinct_texels({100, 100}, TexelKind::kByte, 300 * kMiB));
  textures_.slots().of_material = {kNone<SlotId>};
  EXPECT_EQ(refusal({.budget_bytes = 20 * kMiB}), "");
  textures_.slots().without_material = SlotId{0};
  EXPECT_NE(refusal({.budget_bytes = 20 * kMiB}), "");
  textures_.slots().slots[0].readable = false;
  EXPECT_EQ(refusal({.budget_bytes = 20 * kMiB}), "");
}

TEST_F(DecodeTest, ImagesThatDoNotFitIntoScratchTogetherAreRefusedByTheLargest) {
  textures_.add(distinct_texels({1U << 14, 1U << 28}, TexelKind::kByte));
  for (int i = 0; i < 50; ++i) {
    textures_.add(distinct_texels({1U << 14, (1U << 28) + 64}, TexelKind::kFloat));
  }
  const std::string text = refusal({});
  EXPECT_EQ(text.find("image1: the images take 2.4 PiB of scratch when decoded, this one alone "
                      "48.0 TiB (16384 x 268435520 texels), but there is room for "),
            0U)
      << text;
  EXPECT_NE(text.find("--tmp-dir"), std::string::npos);
}

TEST_F(DecodeTest, EachImageIsOpenedOnce) {
  for (int i = 0; i < 9; ++i) textures_.add(distinct_texels({100, 100}, TexelKind::kByte));
  TestEngine engine({.workers = 3});
  decode(engine);
  EXPECT_EQ(count_.opened.size(), 9U);
  for (const auto& [name, times] : count_.opened) EXPECT_EQ(times, 1) << name;
  EXPECT_LE(count_.most_at_a_time, 3);
}

TEST_F(DecodeTest, ImagesLargerThanAShareAreDecodedOneAfterTheOther) {
  for (int i = 0; i < 6; ++i) {
    textures_.add(distinct_texels({50, 2000}, TexelKind::kByte, 6 * kMiB));
  }
  TestEngine engine({.budget_bytes = 20 * kMiB, .workers = 4});
  const TexelStore store = decode(engine);
  for (std::uint32_t slot = 0; slot < 6; ++slot) {
    EXPECT_TRUE(store.image(SlotId{slot}).decoded) << slot;
  }
  EXPECT_EQ(count_.most_at_a_time, 1);
  EXPECT_GE(engine.budget.peak_bytes(), 6 * kMiB);
  EXPECT_LT(engine.budget.peak_bytes(), 7 * kMiB);
  EXPECT_EQ(engine.budget.free_bytes(), 20 * kMiB);
}

TEST_F(DecodeTest, ImagesThatFitTogetherReserveForAllWorkers) {
  for (int i = 0; i < 6; ++i) {
    textures_.add(distinct_texels({50, 50}, TexelKind::kByte, 6 * kMiB));
  }
  TestEngine engine({.budget_bytes = 30 * kMiB, .workers = 4});
  decode(engine);
  EXPECT_GE(engine.budget.peak_bytes(), 24 * kMiB);
  EXPECT_LT(engine.budget.peak_bytes(), 25 * kMiB);
}

TEST_F(DecodeTest, BrokenImagesAreWarningsAndTheOthersAreDecoded) {
  MemoryImage cut = distinct_texels({100, 300}, TexelKind::kByte);
  cut.good_rows = 200;
  textures_.add(cut);
  textures_.add(distinct_texels({100, 300}, TexelKind::kByte));
  textures_.slots().slots.push_back(textures_.slots().slots[1]);
  textures_.slots().slots[2].source.path = "gone";
  TestEngine engine;
  Warnings warnings([&](const std::string& text) { warned_.push_back(text); });
  const TexelStore store =
      decode_images(engine, textures_.slots(), {true, true, true}, plan(), warnings);
  EXPECT_FALSE(store.image(SlotId{0}).decoded);
  EXPECT_TRUE(store.image(SlotId{1}).decoded);
  EXPECT_FALSE(store.image(SlotId{2}).decoded);
  EXPECT_EQ(store.tile_count(), 10U);
  EXPECT_EQ(warned_, (std::vector<std::string>{
                         "model.obj: image0: it is cut short; its seams are not sampled",
                         "model.obj: gone: missing; its seams are not sampled"}));
}

TEST_F(DecodeTest, ImageThatChangedSinceItsHeaderWasReadIsNotDecoded) {
  textures_.add(distinct_texels({100, 300}, TexelKind::kByte));
  textures_.add(distinct_texels({100, 300}, TexelKind::kByte));
  textures_.slots().slots[0].size->height = 299;
  textures_.slots().slots[1].kind = TexelKind::kShort;
  TestEngine engine;
  EXPECT_EQ(decode(engine).tile_count(), 0U);
  ASSERT_EQ(warned_.size(), 2U);
  EXPECT_EQ(warned_[0],
            "model.obj: image0: the image has changed since the run began; its seams are not "
            "sampled");
}

TEST_F(DecodeTest, WarningsComeInTheOrderOfTheImages) {
  for (std::uint32_t i = 0; i < 20; ++i) {
    MemoryImage bad = distinct_texels({10 + i * 7 % 5, 10}, TexelKind::kByte);
    bad.good_rows = 3;
    textures_.add(bad);
  }
  TestEngine engine({.workers = 5});
  decode(engine);
  const std::vector<std::string> several = warned_;
  warned_.clear();
  TestEngine alone({.workers = 1});
  decode(alone);
  EXPECT_EQ(several, warned_);
}

TEST_F(DecodeTest, ShortageIsNoFaultOfAnImage) {
  textures_.add(distinct_texels({10, 10}, TexelKind::kByte));
  const std::vector<bool> all{true};
  Warnings warnings([](const std::string& text) { ADD_FAILURE() << text; });
  TestEngine engine;
  DecodePlan plan;
  plan.open_image = [](const ImageSource&) -> std::unique_ptr<ImageRows> {
    throw std::bad_alloc();
  };
  EXPECT_THROW(decode_images(engine, textures_.slots(), all, plan, warnings), std::bad_alloc);
  plan.open_image = [](const ImageSource&) -> std::unique_ptr<ImageRows> {
    throw Error(ErrorKind::kResource, "no disk");
  };
  EXPECT_THROW(decode_images(engine, textures_.slots(), all, plan, warnings), Error);
}

}  // namespace
}  // namespace atlasgauge
