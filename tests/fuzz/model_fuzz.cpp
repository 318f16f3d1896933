#include <array>
#include <string>

#include "tests/fuzz/compare_model.hpp"

// Small models of every shape and defect, statement by statement, measured by the pipeline and by
// the oracle. Coordinates lie on a lattice where products are exact, so that all keys must agree.
namespace atlasgauge {
namespace {

const ImageSizes kImages = {{"a.png", {64, 32}}, {"b two.png", {33, 8}}, {"c.png", {1, 1}}};
constexpr std::array kImageNames = {"a.png", "b two.png", "c.png", ".\\a.png", "missing.png"};
constexpr std::array kMaterials = {"first", "second one", "third", "fourth", "#", ""};
constexpr std::array kOptions = {"", "", "-s 1 1 1 ", "-o 0.5 0 -bm 1 ", "-clamp on "};
constexpr std::array kCoordinates = {"0",   "1",   "2",    "0.5",  "-1", "-0",   "0.25",   "3",
                                     "1e1", "nan", "-inf", "+.75", "1.", "1e-3", "1.#INF", "8"};
constexpr std::array kNoise = {
    "# f 1 2 3", "",   "vn 0 0 1", "o thing",   "s off", "l 1 2", "mtllib", "f 1 2", "f 1 2 3 #",
    "f",         "vt", "v 1 2",    "f 1/x 2 3", "odd",   "\t",    "g a b",  "vp 1",  "usemtl a #b"};

class ModelWriter {
 public:
  explicit ModelWriter(FuzzedDataProvider& input) : input_(input) {
    line_end_ = input_.ConsumeBool() ? "\n" : "\r\n";
  }

  std::string materials() {
    std::string text;
    for (int count = input_.ConsumeIntegralInRange(0, 5); count > 0; --count) {
      text += std::string("newmtl ") + pick(kMaterials) + line_end_;
      for (int maps = input_.ConsumeIntegralInRange(0, 2); maps > 0; --maps) {
        text += std::string("  map_Kd ") + pick(kOptions) + pick(kImageNames) + line_end_;
      }
    }
    return text;
  }

  std::string geometry() {
    constexpr int kMostStatements = 150;
    if (input_.ConsumeBool()) add("mtllib model.mtl");
    for (int i = 0; i < kMostStatements && input_.remaining_bytes() > 0; ++i) add_statement();
    return text_;
  }

 private:
  void add_statement() {
    switch (input_.ConsumeIntegralInRange(0, 15)) {
      case 0:
      case 1:
      case 2:
      case 3:
        return add_position();
      case 4:
      case 5:
        return add_texcoord();
      case 6:
      case 7:
        return add_patch();
      case 8:
        return add(std::string("usemtl ") + pick(kMaterials));
      case 9:
        return add(pick(kNoise));
      default:
        return add_polygon();
    }
  }

  void add_position() {
    ++positions_;
    add("v " + coordinate() + " " + coordinate() + " " + coordinate());
  }

  void add_texcoord() {
    ++texcoords_;
    add("vt " + coordinate() +
        (input_.ConsumeIntegralInRange(0, 7) == 0 ? "" : " " + coordinate()));
  }

  /// A square of the lattice, welded with its neighbours by position and maybe by UV.
  void add_patch() {
    const int x = input_.ConsumeIntegralInRange(0, 3), y = input_.ConsumeIntegralInRange(0, 3);
    const int chart = input_.ConsumeIntegralInRange(0, 2);
    const bool flipped = input_.ConsumeBool();
    for (const auto& [dx, dy] :
         std::array<std::array<int, 2>, 4>{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}) {
      const std::string at = std::to_string(x + dx) + " " + std::to_string(y + dy);
      add("v " + at + " 0");
      add("vt " + std::to_string(0.25 * (x + dx) + chart) + " " + std::to_string(0.25 * (y + dy)));
    }
    positions_ += 4;
    texcoords_ += 4;
    add(flipped ? "f -1/-1 -2/-2 -3/-3 -4/-4" : "f -4/-4 -3/-3 -2/-2 -1/-1");
  }

  void add_polygon() {
    std::string line = "f";
    const int corners = input_.PickValueInArray({3, 3, 3, 3, 4, 5, 12, 40});
    for (int i = 0; i < corners; ++i) {
      if (input_.ConsumeIntegralInRange(0, 63) == 0) line += " \\" + line_end_;
      line += " " + index(positions_);
      const int form = input_.ConsumeIntegralInRange(0, 7);
      if (form == 0) line += "//1";
      if (form > 1) line += "/" + index(texcoords_);
      if (form == 2) line += "/1";
    }
    add(line);
  }

  /// Mostly near the last; sometimes one to come, or none at all.
  std::string index(int count) {
    const int drawn = input_.ConsumeIntegralInRange(0, 255);
    if (drawn == 255) return input_.PickValueInArray({"0", "99999999999999999999", "4294967296"});
    if (drawn >= 240) return std::to_string(count + drawn - 240);
    if (drawn % 2 == 0) return "-" + std::to_string(1 + drawn / 2 % 16);
    return std::to_string(1 + drawn / 2 % (count + 1));
  }

  std::string coordinate() {
    if (input_.ConsumeBool()) return pick(kCoordinates);
    constexpr double kLattice = 0.0625;
    return std::to_string(kLattice * input_.ConsumeIntegralInRange(-64, 64));
  }

  template <std::size_t N>
  std::string pick(const std::array<const char*, N>& texts) {
    return texts[input_.ConsumeIntegralInRange<std::size_t>(0, N - 1)];
  }

  void add(const std::string& line) { text_ += line + line_end_; }

  FuzzedDataProvider& input_;
  std::string line_end_;
  std::string text_;
  int positions_ = 0;
  int texcoords_ = 0;
};

void run(FuzzedDataProvider& input) {
  static const fuzz::ModelFolder folder(kImages);
  const PipelineConfig config = fuzz::draw_config(input);
  ModelWriter writer(input);
  folder.write_materials(writer.materials());
  folder.compare(writer.geometry(), config, Closeness::kAllKeys);
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  FuzzedDataProvider input(data, bytes);
  atlasgauge::run(input);
  return 0;
}
