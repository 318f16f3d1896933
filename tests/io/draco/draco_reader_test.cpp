#include "io/draco/draco_reader.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/file/byte_source.hpp"
#include "tests/support/collect_sink.hpp"
#include "tests/support/compressed.hpp"
#include "tests/support/draco_stream.hpp"
#include "tests/support/obj_text.hpp"
#include "tests/support/shared_folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

/// All that a file says.
struct DracoContent {
  CollectSink mesh;
  PartCounts counts;
  PartMaterials materials;
  std::optional<Quantization> quantization;
  std::uint64_t memory_bytes = 0;
  std::vector<std::string> messages;
};

DracoContent read_drc(const std::string& path) {
  DracoContent content;
  Warnings warnings([&](const std::string& text) { content.messages.push_back(text); });
  DracoReader reader(path, warnings);
  const std::unique_ptr<MeshPart> part = reader.next();
  content.counts = part->counts();
  content.memory_bytes = part->memory_bytes();
  content.materials = reader.materials();
  part->load();
  part->emit(content.mesh, warnings);
  content.quantization = part->quantization();
  EXPECT_EQ(reader.next(), nullptr);
  return content;
}

std::string error_of(const std::string& path) {
  try {
    read_drc(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    return error.what();
  }
  return "";
}

std::vector<std::uint32_t> materials_of(const CollectSink& mesh) {
  std::vector<std::uint32_t> result;
  for (const FaceRecord& face : mesh.faces) result.push_back(raw(face.material));
  return result;
}

using Images = std::vector<std::optional<std::uint32_t>>;
constexpr std::uint32_t kNo = raw(kNone<MaterialId>);

TEST(DracoReader, HandsOutAFileAsOnePart) {
  const TempDir dir;
  const std::string stream = encode_draco(*DracoGrid{.cells = 70}.mesh(), {true, 5, 16, 14});
  const DracoContent drc = read_drc(dir.write("model.drc", stream));
  EXPECT_EQ(drc.mesh.faces.size(), 9800U);
  EXPECT_EQ(drc.mesh.positions.size(), 71U * 71);
  EXPECT_EQ(drc.mesh.texcoords.size(), 71U * 71);
  EXPECT_EQ(drc.counts.faces, 9800U);
  EXPECT_EQ(drc.counts.positions, 71U * 71);
  EXPECT_GT(drc.memory_bytes, stream.size() + 9800 * 100);
  EXPECT_EQ(drc.quantization->position_bits, 16U);
  EXPECT_TRUE(drc.materials.images.empty());
  EXPECT_EQ(materials_of(drc.mesh), std::vector<std::uint32_t>(9800, kNo));
}

TEST(DracoReader, FindsImagesByTheNamesOfMaterials) {
  const TempDir dir;
  const std::string path = dir.write(
      "model.drc", encode_draco(*DracoGrid{.cells = 1, .has_materials = true}.mesh(), {false}));
  dir.write("model.mtl",
            "newmtl other\nmap_Kd z.png\nnewmtl roof tiles\nmap_Kd maps\\roof.png\n"
            "newmtl wall\nnewmtl roof tiles\nmap_Kd never.png\n");
  dir.write("model.png", "");
  const std::string roof = dir.write("maps/roof.png", "");
  const DracoContent drc = read_drc(path);
  ASSERT_EQ(drc.materials.images.size(), 2U);
  EXPECT_EQ(drc.materials.images[0].name, "z.png");
  EXPECT_EQ(drc.materials.images[1].name, "maps/roof.png");
  EXPECT_EQ(drc.materials.images[1].source.path, std::filesystem::canonical(roof));
  EXPECT_EQ(drc.materials.image_of_material, (Images{std::nullopt, 1U}));
  EXPECT_EQ(materials_of(drc.mesh), (std::vector<std::uint32_t>{0, 1}));
}

TEST(DracoReader, TakesTheImageBesideTheFileForAllFacesOtherwise) {
  const TempDir dir;
  const std::string path = dir.write(
      "model.drc", encode_draco(*DracoGrid{.cells = 1, .has_materials = true}.mesh(), {false}));
  dir.write("model.jpeg", "");
  const DracoContent drc = read_drc(path);
  ASSERT_EQ(drc.materials.images.size(), 1U);
  EXPECT_EQ(drc.materials.images[0].name, "model.jpeg");
  EXPECT_EQ(drc.materials.image_of_material, (Images{0U}));
  EXPECT_EQ(materials_of(drc.mesh), (std::vector<std::uint32_t>{0, 0}));
}

TEST(DracoReader, ReadsMetadataLongerThanItsFirstLook) {
  const TempDir dir;
  const std::unique_ptr<draco::Mesh> mesh = DracoGrid{.cells = 1, .has_materials = true}.mesh();
  auto metadata = std::make_unique<draco::GeometryMetadata>(*mesh->GetMetadata());
  metadata->AddEntryString("text", std::string(70000, 'x'));
  mesh->AddMetadata(std::move(metadata));
  dir.write("model.mtl", "newmtl wall\nmap_Kd wall.png\n");
  const DracoContent drc = read_drc(dir.write("model.drc", encode_draco(*mesh, {})));
  EXPECT_EQ(drc.mesh.faces.size(), 2U);
  EXPECT_EQ(drc.materials.image_of_material, (Images{0U, std::nullopt}));
}

TEST(DracoReader, WarnsAboutALibraryThatCannotBeRead) {
  const TempDir dir;
  const std::string path = dir.write(
      "model.drc", encode_draco(*DracoGrid{.cells = 1, .has_materials = true}.mesh(), {}));
  dir.write("model.mtl", std::string("newmtl \0\0\0\1", 11) + "\nmap_Kd\n");
  EXPECT_NO_THROW(read_drc(path));
}

TEST(DracoReader, RefusesWhatIsNoStreamInAPlainFile) {
  const TempDir dir;
  const std::string stream = encode_draco(*DracoGrid{}.mesh(), {});
  EXPECT_NE(error_of(dir.write("a.drc", gzip(stream))).find("unpack it"), std::string::npos);
  EXPECT_NE(error_of(dir.write("b.drc", "")).find("found an empty file"), std::string::npos);
  EXPECT_NE(error_of(dir.write("c.drc", "glTF and more")).find("no Draco stream"),
            std::string::npos);
  EXPECT_NE(error_of(dir.write("d.drc", stream.substr(0, 14))).find("cut short"),
            std::string::npos);
  EXPECT_NE(error_of((dir.path() / "nowhere.drc").string()).find("cannot open"), std::string::npos);
}

TEST(DracoReader, WarnsAboutValuesThatAreNotFinite) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const std::array<float, 9> values = {0, 0, 0, 1, 0, 0, INFINITY, 1, 0};
  builder.SetAttributeValuesForFace(0, draco::FaceIndex(0), &values[0], &values[3], &values[6]);
  const TempDir dir;
  const DracoContent drc =
      read_drc(dir.write("model.drc", encode_draco(*builder.Finalize(), {false, 5, 0, 0})));
  ASSERT_EQ(drc.messages.size(), 1U);
  EXPECT_NE(drc.messages[0].find("the position is not finite"), std::string::npos);
}

class SharedDrc : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) {
      GTEST_SKIP() << "NOTE: no models beside this checkout, nothing is compared";
    }
  }
  std::filesystem::path folder_ = shared_folder() / "data/draco";
};

/// Position and texture coordinate of every corner, to a thousandth, in no order of faces.
std::vector<std::array<long, 5>> corners_of(const CollectSink& mesh) {
  std::vector<std::array<long, 5>> corners;
  for (const FaceRecord& face : mesh.faces) {
    for (int i = 0; i < 3; ++i) {
      const Position& p = mesh.positions[raw(face.v[i])];
      const TexCoord& t = mesh.texcoords[raw(face.t[i])];
      corners.push_back({std::lround(p.x * 1000), std::lround(p.y * 1000), std::lround(p.z * 1000),
                         std::lround(t.u * 1000), std::lround(t.v * 1000)});
    }
  }
  std::ranges::sort(corners);
  return corners;
}

TEST_F(SharedDrc, HasTheCornersOfItsTwinInObj) {
  const auto source = open_byte_source((folder_ / "cube_att.obj").string());
  const auto expected = corners_of(read_obj(*source).mesh);
  for (const char* const name :
       {"cube_att.obj.edgebreaker.cl10.2.2.drc", "cube_att.obj.edgebreaker.cl4.2.2.drc",
        "cube_att.obj.sequential.cl3.2.2.drc", "cube_att.drc"}) {
    EXPECT_EQ(corners_of(read_drc((folder_ / name).string()).mesh), expected) << name;
  }
}

}  // namespace
}  // namespace atlasgauge
