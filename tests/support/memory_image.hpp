#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "io/error.hpp"
#include "io/image/image_reader.hpp"

namespace atlasgauge {

/// An image that a function makes: component `channel` of the texel in `column` and `row` from the
/// top left, as the kind stores it.
struct MemoryImage {
  ImageHeader header;
  std::function<double(std::uint32_t column, std::uint32_t row, int channel)> component;
  /// Rows that the file holds; the others cannot be read.
  std::uint32_t good_rows = ~std::uint32_t{0};
};

class MemoryImageRows : public ImageRows {
 public:
  MemoryImageRows(std::string path, const MemoryImage& image)
      : path_(std::move(path)), image_(image) {}

  const ImageHeader& header() const override { return image_.header; }
  void read(std::uint32_t rows, std::byte* to) override {
    for (; rows > 0; --rows, ++row_) {
      if (row_ >= image_.good_rows) throw Error(ErrorKind::kInput, path_, 0, "it is cut short");
      for (std::uint32_t column = 0; column < image_.header.size.width; ++column) {
        for (int channel = 0; channel < 3; ++channel) to = store(column, channel, to);
      }
    }
  }

 private:
  std::byte* store(std::uint32_t column, int channel, std::byte* to) const {
    const double value = image_.component(column, row_, channel);
    if (image_.header.kind == TexelKind::kByte) return put(static_cast<std::uint8_t>(value), to);
    if (image_.header.kind == TexelKind::kShort) return put(static_cast<std::uint16_t>(value), to);
    return put(static_cast<float>(value), to);
  }

  template <class Value>
  static std::byte* put(Value value, std::byte* to) {
    std::memcpy(to, &value, sizeof(value));
    return to + sizeof(value);
  }

  std::string path_;
  const MemoryImage& image_;
  std::uint32_t row_ = 0;
};

/// Opens these images, which must live as long; others are missing.
inline OpenImage open_from(const std::map<std::string, MemoryImage>& images) {
  return [&images](const ImageSource& source) -> std::unique_ptr<ImageRows> {
    const std::string& path = source.path;
    const auto found = images.find(path);
    if (found == images.end()) throw Error(ErrorKind::kInput, path, 0, "missing");
    return std::make_unique<MemoryImageRows>(path, found->second);
  };
}

}  // namespace atlasgauge
