#include "tests/support/computed_images.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

ImageHeader header_of(const ComputedImage& image) {
  return {.size = image.size, .kind = image.kind};
}

template <class Value>
std::byte* put(Value value, std::byte* to) {
  std::memcpy(to, &value, sizeof value);
  return to + sizeof value;
}

std::byte* put_component(TexelKind kind, double value, std::byte* to) {
  switch (kind) {
    case TexelKind::kByte:
      return put(static_cast<std::uint8_t>(std::lround(value)), to);
    case TexelKind::kShort:
      return put(static_cast<std::uint16_t>(std::lround(value * 257)), to);
    case TexelKind::kFloat:
      break;
  }
  return put(static_cast<float>(value / 255), to);
}

class ComputedRows : public ImageRows {
 public:
  ComputedRows(ComputedImage image, std::string path)
      : image_(std::move(image)), header_(header_of(image_)), path_(std::move(path)) {}

  const ImageHeader& header() const override { return header_; }

  void read(std::uint32_t rows, std::byte* to) override {
    for (const std::uint32_t end = row_ + rows; row_ < end; ++row_) {
      const bool present = row_ < image_.size.height && row_ != image_.broken_row;
      if (!present) throw Error(ErrorKind::kInput, path_, 0, "no row " + std::to_string(row_));
      to = put_row(to);
    }
  }

 private:
  std::byte* put_row(std::byte* to) const {
    for (std::uint32_t column = 0; column < image_.size.width; ++column) {
      for (const double value : image_.colour(column, row_)) {
        to = put_component(image_.kind, value, to);
      }
    }
    return to;
  }

  ComputedImage image_;
  ImageHeader header_;
  std::string path_;
  std::uint32_t row_ = 0;
};

const ComputedImage& find(const std::map<std::string, ComputedImage>& images,
                          const std::string& path) {
  const auto found = images.find(std::filesystem::path(path).filename().string());
  if (found == images.end()) throw Error(ErrorKind::kInput, path, 0, "missing");
  return found->second;
}

}  // namespace

ComputedImages::ComputedImages(std::map<std::string, ComputedImage> images)
    : images_(std::move(images)) {}

ImageProbe ComputedImages::probe() const {
  return
      [images = images_](const ImageSource& image) { return header_of(find(images, image.path)); };
}

OpenImage ComputedImages::open() const {
  return [images = images_](const ImageSource& image) -> std::unique_ptr<ImageRows> {
    return std::make_unique<ComputedRows>(find(images, image.path), image.path);
  };
}

}  // namespace atlasgauge
