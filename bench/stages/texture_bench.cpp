// What it costs to decode images into tiles in scratch.

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "bench/images.hpp"
#include "bench/stages/bench_engine.hpp"
#include "bench/stages/job.hpp"
#include "bench/temp_folder.hpp"
#include "io/image/image_reader.hpp"
#include "stream/seams/decode.hpp"

namespace {

using namespace atlasgauge;

struct Pictures {
  std::vector<std::string> paths;
  std::uint64_t side;
  double most_difference;  ///< of a component on average: what the format loses
};

TextureSlots slots_of(const Pictures& pictures) {
  TextureSlots slots;
  slots.has_images = true;
  for (const std::string& path : pictures.paths) {
    const ImageHeader header = read_image_header({.path = path});
    slots.slots.push_back(
        {path, {.path = path}, header.size, true, header.kind, header.decoder_bytes});
    slots.of_material.push_back(SlotId{static_cast<std::uint32_t>(slots.slots.size() - 1)});
  }
  return slots;
}

class DecodeJob : public Job {
 public:
  DecodeJob(const Pictures& pictures, Room room, std::size_t threads)
      : pictures_(pictures), room_(room), threads_(threads), slots_(slots_of(pictures)) {}

  void prepare() override {
    store_ = {};
    const std::uint64_t bytes = pictures_.paths.size() * 3 * pictures_.side * pictures_.side;
    engine_ = std::make_unique<BenchEngine>(room_, bytes, threads_);
  }
  void run() override {
    const std::vector<bool> all(slots_.slots.size(), true);
    const DecodePlan plan{.model = "none", .open_image = open_image, .spare_bytes = kSpareBytes};
    store_ = decode_images(engine_->engine(), slots_, all, plan, warnings_);
  }
  void check() override {
    for (std::size_t i = 0; i < pictures_.paths.size(); ++i) {
      expect(mean_difference(i) <= pictures_.most_difference, "an image is another");
    }
    expect(engine_->kept_to_its_room(), "scratch is not where it should be");
  }

 private:
  static constexpr std::uint64_t kSpareBytes = 64 << 20;

  double mean_difference(std::size_t image) {
    const StoredImage& stored = store_.image(SlotId{static_cast<std::uint32_t>(image)});
    expect(stored.decoded, "an image was not decoded");
    TileCache cache(store_, stored.layout.columns());
    const PaintRow paint = photo(pictures_.side, image);
    std::vector<std::uint8_t> row(3 * pictures_.side);
    double difference = 0;
    for (std::uint32_t y = 0; y < pictures_.side; ++y) {
      paint(y, row.data());
      for (std::uint32_t x = 0; x < pictures_.side; ++x) {
        const std::uint32_t tile = stored.first_tile +
                                   y / TileLayout::kSide * stored.layout.columns() +
                                   x / TileLayout::kSide;
        const std::byte* texel = cache.at(tile).texel(x % TileLayout::kSide, y % TileLayout::kSide);
        for (std::size_t c = 0; c < 3; ++c) {
          difference += std::abs(std::to_integer<int>(texel[c]) - row[3 * x + c]);
        }
      }
    }
    return difference / static_cast<double>(3 * pictures_.side * pictures_.side);
  }

  const Pictures& pictures_;
  Room room_;
  std::size_t threads_;
  TextureSlots slots_;
  Warnings warnings_{{}, true};  // any is an error
  std::unique_ptr<BenchEngine> engine_;
  TexelStore store_;
};

Pictures make_pictures(const std::string& folder, const std::string& format, std::uint64_t side) {
  Pictures pictures{{}, side, format == "png" ? 0.0 : 12.0};
  for (std::uint64_t image = 0; image < 2; ++image) {
    pictures.paths.push_back(folder + "/" + std::to_string(image) + "." + format);
    write_image(pictures.paths.back(), side, photo(side, image));
  }
  return pictures;
}

}  // namespace

int main(int argc, char** argv) {
  ::setenv("ATLASGAUGE_MODULE_DIR", ATLASGAUGE_MODULES, 0);
  std::unique_ptr<TempFolder> folder;
  std::vector<Pictures> pictures;
  const auto jobs = [&](std::uint64_t side) {
    folder = std::make_unique<TempFolder>();
    const std::vector<std::string> formats{"jpg", "png"};
    for (const std::string& format : formats) {
      pictures.push_back(make_pictures(folder->path(), format, side));
    }
    std::vector<NamedJob> all;
    for (std::size_t i = 0; i < formats.size(); ++i) {
      for (const Room room : {Room::kInMemory, Room::kBeyondMemory}) {
        for (const std::size_t threads : kThreads) {
          all.push_back(
              {"decode/" + formats[i] + "/" + name_of(room) + "/threads:" + std::to_string(threads),
               [=, &pictures] { return std::make_unique<DecodeJob>(pictures[i], room, threads); },
               "texel", pictures[i].paths.size() * side * side});
        }
      }
    }
    return all;
  };
  return run_subject(argc, argv, {"SIDE", 2048, jobs});
}
