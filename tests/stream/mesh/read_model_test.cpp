#include "stream/mesh/read_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "io/error.hpp"
#include "tests/support/engine_fixture.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

/// A part of one triangle (0, 1, 2), with texture coordinates of the same numbers.
struct TrianglePart {
  double x = 0;  ///< of all its positions
  std::uint32_t material = 0;
  std::uint64_t bytes = 0;
  Quantization quantization{};
  std::string fault{};
};

/// Watches what is loaded at a time.
struct Loads {
  std::mutex mutex;
  std::uint64_t bytes = 0;
  std::uint64_t most_bytes = 0;

  void add(std::uint64_t more) {
    const std::lock_guard lock(mutex);
    bytes += more;
    most_bytes = std::max(most_bytes, bytes);
  }
  void remove(std::uint64_t less) {
    const std::lock_guard lock(mutex);
    bytes -= less;
  }
};

class FakePart : public MeshPart {
 public:
  FakePart(TrianglePart part, Loads& loads) : part_(std::move(part)), loads_(loads) {}
  ~FakePart() override { loads_.remove(loaded_bytes_); }

  PartCounts counts() const override { return {3, 3, 1}; }
  std::uint64_t memory_bytes() const override { return part_.bytes; }
  void load() override {
    if (!part_.fault.empty()) throw Error(ErrorKind::kInput, part_.fault);
    loads_.add(part_.bytes);
    loaded_bytes_ = part_.bytes;
  }
  void emit(MeshSink& sink, Warnings&) override {
    const Position p[3] = {{part_.x, 0, 0}, {part_.x, 1, 0}, {part_.x, 0, 1}};
    const TexCoord t[3] = {{0, 0}, {1, 0}, {0, 1}};
    FaceRecord face{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      face.v[k] = VertexId{k};
      face.t[k] = TexCoordId{k};
    }
    face.material = MaterialId{part_.material};
    sink.add({.positions = p, .texcoords = t, .faces = {&face, 1}});
  }
  std::optional<Quantization> quantization() const override {
    if (part_.quantization.position_bits + part_.quantization.uv_bits == 0) return std::nullopt;
    return part_.quantization;
  }

 private:
  TrianglePart part_;
  Loads& loads_;
  std::uint64_t loaded_bytes_ = 0;
};

class FakeReader : public PartReader {
 public:
  FakeReader(std::vector<TrianglePart> parts, Loads& loads)
      : parts_(std::move(parts)), loads_(loads) {
    for (const TrianglePart& part : parts_) {
      materials_.image_of_material.resize(
          std::max<std::size_t>(materials_.image_of_material.size(), part.material + 1));
    }
  }
  std::unique_ptr<MeshPart> next() override {
    if (next_ == parts_.size()) return nullptr;
    return std::make_unique<FakePart>(parts_[next_++], loads_);
  }
  const PartMaterials& materials() const override { return materials_; }

 private:
  std::vector<TrianglePart> parts_;
  Loads& loads_;
  PartMaterials materials_;
  std::size_t next_ = 0;
};

class ReadModelTest : public ::testing::Test {
 protected:
  ReadModel read(TestEngine& engine, const std::vector<std::string>& inputs) {
    Warnings warnings([this](const std::string& text) { warned_.push_back(text); });
    const OpenParts open = [this](const std::string& path, Warnings&) {
      const auto found = parts_.find(path);
      return found == parts_.end() ? nullptr : std::make_unique<FakeReader>(found->second, loads_);
    };
    return read_model(engine, inputs, open, warnings);
  }

  TempDir dir_;
  Loads loads_;
  std::map<std::string, std::vector<TrianglePart>> parts_;
  std::vector<std::string> warned_;
};

TEST_F(ReadModelTest, PartsFollowEachOtherWithIndicesAndMaterialsOfTheModel) {
  parts_["a"] = {{.x = 1}, {.x = 2, .material = 1}};
  parts_["b"] = {{.x = 3}};
  TestEngine engine;
  ReadModel model = read(engine, {"a", "b"});
  const std::vector<FaceRecord> faces = records_of(model.mesh.faces);
  ASSERT_EQ(faces.size(), 3U);
  const std::vector<Position> positions = records_of(model.mesh.positions);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(raw(faces[i].v[0]), 3 * i);
    EXPECT_EQ(raw(faces[i].t[2]), 3 * i + 2);
    EXPECT_EQ(raw(faces[i].material), i) << "b's first material follows the two of a";
    EXPECT_EQ(positions[3 * i].x, i + 1);
  }
  ASSERT_EQ(model.mesh.parts.size(), 3U);
  EXPECT_EQ(model.mesh.parts[2].first_face, 2U);
  EXPECT_EQ(model.materials[0].size(), 2U);
}

TEST_F(ReadModelTest, ObjFilesAndPartsMakeOneModel) {
  const std::string obj =
      dir_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
  parts_["b"] = {{.x = 3}};
  TestEngine engine;
  ReadModel model = read(engine, {obj, "b", obj});
  const std::vector<FaceRecord> faces = records_of(model.mesh.faces);
  ASSERT_EQ(faces.size(), 3U);
  EXPECT_EQ(raw(faces[1].v[0]), 3U);
  EXPECT_EQ(raw(faces[1].t[0]), 1U);
  EXPECT_EQ(raw(faces[2].v[2]), 8U);
  EXPECT_EQ(raw(faces[2].t[2]), 4U);
  EXPECT_EQ(raw(faces[2].material), 2U);
}

TEST_F(ReadModelTest, WhatNamesNothingInItsPartNamesNothingInTheModel) {
  const std::string loose = dir_.write(
      "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1 2 3\nf 1 2 4\nf 1/1 2/2 3/1\nf 3 2 1\n");
  const std::string next =
      dir_.write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 1\nf 1 2 9\nf 1/1 2/2 3/1\n");
  TestEngine engine;
  ReadModel model = read(engine, {loose, next});
  const std::vector<FaceRecord> faces = records_of(model.mesh.faces);
  EXPECT_EQ(model.mesh.invalid_polygons, 2U);
  ASSERT_EQ(faces.size(), 4U);
  EXPECT_EQ(faces[1].t[1], kNone<TexCoordId>) << "not the first of the next part";
  EXPECT_EQ(raw(faces[1].t[2]), 0U);
  EXPECT_EQ(raw(faces[3].t[1]), 2U);
  EXPECT_EQ(model.mesh.parts[1].first_face, 3U) << "one of the first part's faces is gone";
  ASSERT_EQ(warned_.size(), 2U);
  EXPECT_NE(warned_[0].find("a.obj:6"), std::string::npos) << warned_[0];
  EXPECT_NE(warned_[1].find("b.obj:6"), std::string::npos) << warned_[1];
}

TEST_F(ReadModelTest, PartsThatTogetherAreTooLargeAreLoadedOneByOne) {
  const std::uint64_t two_thirds = (std::uint64_t{2} << 20) / 3 * 2;
  for (int i = 0; i < 12; ++i) parts_["a"].push_back({.x = 1.0 * i, .bytes = two_thirds});
  TestEngine engine({.budget_bytes = 2 << 20, .workers = 4});
  ReadModel model = read(engine, {"a"});
  EXPECT_EQ(model.mesh.faces.size(), 12U);
  const std::vector<Position> positions = records_of(model.mesh.positions);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(positions[3 * i].x, static_cast<double>(i));
  EXPECT_EQ(loads_.most_bytes, two_thirds);
}

TEST_F(ReadModelTest, SmallPartsDoNotStarveALargeOne) {
  const std::uint64_t little = 10'000, most = (std::uint64_t{2} << 20) / 10 * 9;
  for (int i = 0; i < 30; ++i) {
    parts_["a"].push_back({.bytes = i % 3 == 1 ? most : little});
  }
  TestEngine engine({.budget_bytes = 2 << 20, .workers = 4});
  EXPECT_EQ(read(engine, {"a"}).mesh.faces.size(), 30U);
}

TEST_F(ReadModelTest, APartBeyondAllMemoryIsRefused) {
  parts_["a"] = {{.bytes = 1000}, {.bytes = 4 << 20}};
  TestEngine engine({.budget_bytes = 2 << 20});
  try {
    read(engine, {"a"});
    FAIL() << "it fits?";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    EXPECT_NE(std::string(error.what()).find("decoding a part of a"), std::string::npos);
  }
}

TEST_F(ReadModelTest, FaultsOfAPartEndTheRun) {
  parts_["a"] = {{}, {.fault = "broken"}, {}};
  TestEngine engine({.workers = 3});
  EXPECT_THROW(read(engine, {"a"}), Error);
}

TEST_F(ReadModelTest, QuantizationIsTheCoarsestOfTheParts) {
  parts_["a"] = {{.quantization = {14, 0.5, 12, 0.25}},
                 {.material = 2, .quantization = {16, 0.125, 10, 0.5}},
                 {}};
  parts_["b"] = {{}};
  TestEngine engine;
  const ReadModel model = read(engine, {"b", "a"});
  ASSERT_EQ(model.quantizations.size(), 1U);
  const InputQuantization& a = model.quantizations[0];
  EXPECT_EQ(a.path, "a");
  EXPECT_EQ(a.parts, 3U);
  EXPECT_EQ(a.quantized_parts, 2U);
  EXPECT_EQ(a.position_bits, 14U);
  EXPECT_EQ(a.position_step, 0.5);
  EXPECT_EQ(a.uv_bits, 10U);
  EXPECT_EQ(a.first_material, 1U);
  EXPECT_EQ(a.uv_steps, (std::vector<double>{0.25, 0, 0.5}));
  EXPECT_EQ(model.mesh.parts[1].position_step, 0.5);
  EXPECT_EQ(model.mesh.parts[3].position_step, 0);
}

}  // namespace
}  // namespace atlasgauge
