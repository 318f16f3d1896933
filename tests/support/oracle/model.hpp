#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What a file says, before anything is measured.
namespace atlasgauge::oracle {

using Size = std::pair<uint32_t, uint32_t>;
using Position = std::array<double, 3>;
using Uv = std::array<float, 2>;
using Triple = std::array<int64_t, 3>;

// Red, green and blue, each from 0 to 255.
using Colour = std::array<double, 3>;

// The colour of a texel, rows counted from the top of the image.
using Pixels = std::function<Colour(int64_t column, int64_t row)>;

struct Options {
  std::optional<Size> size_option;
  // The size of a readable image. The path is normal, with the folder of the MTL or of the OBJ in
  // front; the file itself need not exist.
  std::function<std::optional<Size>(const std::string& path)> image_size;
  // The pixels of a readable image; none where they cannot be decoded.
  std::function<Pixels(const std::string& path)> image_pixels;
  bool texmetro_seams = false;  // sample seams as TexMetro does, too
};

struct Slot {
  std::string name;
  std::string path;
  std::optional<Size> size;
  Pixels pixels;  // none where there is nothing to sample
};

struct Face {
  Triple vertices;
  std::array<std::optional<Uv>, 3> uvs;  // only finite ones, as in the file
  std::optional<int64_t> slot;
};

struct Model {
  std::string name;
  std::vector<Position> positions;
  std::vector<Slot> slots;
  std::vector<Face> faces;
  bool with_images = false;
  bool counts_texels = true;  // not so on the 1x1 slot of a model without images and without size
  int64_t invalid_polygons = 0;
};

// Throws std::runtime_error, naming the line, on a statement whose numbers cannot be read.
Model read_obj(const std::string& obj_path, const Options& options);

}  // namespace atlasgauge::oracle
