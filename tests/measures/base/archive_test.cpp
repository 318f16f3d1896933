#include "measures/base/archive.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace atlasgauge {
namespace {

struct Nested {
  std::uint8_t small = 0;
  double number = 0;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(small, number);
  }
};

TEST(ArchiveTest, LoadsWhatWasSavedInThatOrder) {
  std::uint64_t count = 7;
  Nested nested{3, std::numeric_limits<double>::denorm_min()};
  Saver saver;
  saver(count, nested);
  EXPECT_EQ(saver.bytes().size(), 8U + 1 + 8);
  Loader loader(saver.bytes());
  std::uint64_t loaded_count = 0;
  Nested loaded;
  loader(loaded_count, loaded);
  EXPECT_EQ(loaded_count, 7U);
  EXPECT_EQ(loaded.small, 3);
  EXPECT_EQ(loaded.number, nested.number);
}

TEST(ArchiveTest, CutShortIsAnInternalError) {
  std::uint64_t count = 7;
  Saver saver;
  saver(count);
  for (std::size_t size = 0; size < 8; ++size) {
    Loader loader({saver.bytes().data(), size});
    try {
      loader(count);
      ADD_FAILURE() << "loaded from " << size << " bytes";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInternal);
    }
  }
}

}  // namespace
}  // namespace atlasgauge
