#include "io/ply/ply_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/file/byte_source.hpp"
#include "tests/support/compressed.hpp"
#include "tests/support/obj_text.hpp"
#include "tests/support/ply_text.hpp"
#include "tests/support/shared_folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint32_t kNo = raw(kNone<TexCoordId>);
using Indices = std::vector<std::uint32_t>;

/// Vertices of all faces, one after the other.
Indices vertices(const CollectSink& mesh) {
  Indices result;
  for (const FaceRecord& face : mesh.faces) {
    for (const VertexId v : face.v) result.push_back(raw(v));
  }
  return result;
}

Indices texcoords(const CollectSink& mesh) {
  Indices result;
  for (const FaceRecord& face : mesh.faces) {
    for (const TexCoordId t : face.t) result.push_back(raw(t));
  }
  return result;
}

Indices materials(const CollectSink& mesh) {
  Indices result;
  for (const FaceRecord& face : mesh.faces) result.push_back(raw(face.material));
  return result;
}

std::vector<double> coordinates(const CollectSink& mesh) {
  std::vector<double> result;
  for (const auto& [x, y, z] : mesh.positions) result.insert(result.end(), {x, y, z});
  return result;
}

std::vector<float> uvs(const CollectSink& mesh) {
  std::vector<float> result;
  for (const auto& [u, v] : mesh.texcoords) result.insert(result.end(), {u, v});
  return result;
}

const std::string kVertexHeader =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFourVertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

/// An ascii file of four vertices and faces.
std::string with_faces(const std::string& comments, int count, const std::string& properties,
                       const std::string& faces) {
  return "ply\nformat ascii 1.0\n" + comments + kVertexHeader + "element face " +
         std::to_string(count) + "\n" + properties + "end_header\n" + kFourVertices + faces;
}

const std::string kIndices = "property list uchar int vertex_indices\n";
const std::string kTexCoords = "property list uchar float texcoord\n";
const std::string kTexNumber = "property int texnumber\n";

/// The text of the error that reading throws, empty if none.
std::string error_of(const std::string& bytes, ErrorKind kind = ErrorKind::kInput) {
  try {
    read_ply(bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "";
}

void expect_error(const std::string& bytes, const std::string& part) {
  const std::string error = error_of(bytes);
  EXPECT_NE(error.find(part), std::string::npos) << error;
}

TEST(PlyReader, ReadsAnAsciiTriangle) {
  const PlyContent ply = read_ply(with_faces("", 1, kIndices, "3 0 1 2\n"));
  EXPECT_EQ(coordinates(ply.mesh), (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(vertices(ply.mesh), (Indices{0, 1, 2}));
  EXPECT_EQ(texcoords(ply.mesh), (Indices{kNo, kNo, kNo}));
  EXPECT_EQ(ply.counts.positions, 4U);
  EXPECT_EQ(ply.counts.faces, 1U);
  EXPECT_TRUE(ply.materials.images.empty());
  EXPECT_TRUE(ply.messages.empty());
}

TEST(PlyReader, MakesAFanOfAPolygon) {
  const PlyContent ply = read_ply(with_faces("", 1, kIndices, "4 3 2 1 0\n"));
  EXPECT_EQ(vertices(ply.mesh), (Indices{3, 2, 1, 3, 1, 0}));
}

TEST(PlyReader, RoundsTextToTheDeclaredType) {
  const PlyContent ply = read_ply(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty double y\n"
      "property int z\nend_header\n0.1 0.1 -7\n");
  EXPECT_EQ(coordinates(ply.mesh), (std::vector<double>{0.1F, 0.1, -7}));
}

TEST(PlyReader, TakesVertexTexCoordsByAnyOfTheirNames) {
  for (const auto& [u, v] : {std::pair{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}) {
    const PlyContent ply =
        read_ply("ply\nformat ascii 1.0\nelement vertex 3\nproperty float " + std::string(u) +
                 "\nproperty float x\nproperty float y\nproperty float z\nproperty float " + v +
                 "\nelement face 1\n" + kIndices +
                 "end_header\n0 1 2 3 0.5\n-0 1 2 3 1\n0.25 1 2 3 2\n3 2 0 1\n");
    EXPECT_EQ(uvs(ply.mesh), (std::vector<float>{0, 0.5F, 0, 1, 0.25F, 2})) << u;
    EXPECT_FALSE(std::signbit(ply.mesh.texcoords[1].u));
    EXPECT_EQ(texcoords(ply.mesh), (Indices{2, 0, 1}));
    EXPECT_EQ(ply.counts.texcoords, 3U);
  }
}

TEST(PlyReader, PrefersTexCoordsOfCorners) {
  const PlyContent ply = read_ply(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float s\nproperty float t\nelement face 2\n" +
      kIndices + kTexCoords +
      "end_header\n0 0 0 9 9\n1 0 0 9 9\n0 1 0 9 9\n"
      "3 0 1 2 6 0 0 1 0 0 1\n3 0 1 2 0\n");
  EXPECT_EQ(uvs(ply.mesh), (std::vector<float>{0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(texcoords(ply.mesh), (Indices{0, 1, 2, kNo, kNo, kNo}));
}

TEST(PlyReader, TakesThePropertiesOfAFaceInAnyOrder) {
  const PlyContent ply =
      read_ply(with_faces("comment TextureFile a.png\ncomment TextureFile b.png\n", 2,
                          "property uchar red\n" + kTexNumber +
                              "property list int double weights\n" + kTexCoords + kIndices,
                          "7 1 2 5 5 8 0 0 1 0 1 1 0 1 4 0 1 2 3\n7 0 0 6 0 0 1 0 1 1 3 3 2 1\n"));
  EXPECT_EQ(vertices(ply.mesh), (Indices{0, 1, 2, 0, 2, 3, 3, 2, 1}));
  EXPECT_EQ(texcoords(ply.mesh), (Indices{0, 1, 2, 0, 2, 3, 4, 5, 6}));
  EXPECT_EQ(materials(ply.mesh), (Indices{1, 1, 0}));
}

TEST(PlyReader, TakesTexCoordsOfAWrongNumberForNone) {
  const PlyContent ply = read_ply(with_faces("", 3, kIndices + kTexCoords,
                                             "3 0 1 2 4 0 0 1 0\n3 0 1 2 7 0 0 1 0 1 1 5\n"
                                             "3 0 1 2 6 0 0 1 0 1 1\n"));
  EXPECT_EQ(texcoords(ply.mesh), (Indices{kNo, kNo, kNo, kNo, kNo, kNo, 0, 1, 2}));
  ASSERT_EQ(ply.messages.size(), 1U);
  EXPECT_NE(ply.messages[0].find("2 polygons"), std::string::npos) << ply.messages[0];
}

TEST(PlyReader, NamesImagesByTheWholeRestOfALineWithSlashes) {
  const TempDir dir;
  const std::string path = dir.write(
      "model.ply",
      with_faces("comment TextureFile   my maps\\a b.png \r\n", 1, kIndices, "3 0 1 2\n"));
  const std::string image = dir.write("my maps/a b.png", "");
  PlyReader reader(path);
  const PlyContent ply = read_ply(reader);
  ASSERT_EQ(ply.materials.images.size(), 1U);
  EXPECT_EQ(ply.materials.images[0].name, "my maps/a b.png");
  EXPECT_EQ(ply.materials.images[0].source.path, std::filesystem::canonical(image));
  EXPECT_EQ(materials(ply.mesh), (Indices{0}));
  EXPECT_EQ(reader.next(), nullptr);
}

TEST(PlyReader, ListsAnImageOnceForAllItsMaterials) {
  const PlyContent ply =
      read_ply(with_faces("comment TextureFile a.png\ncomment TextureFile b.png\n"
                          "comment TextureFile x/../a.png\n",
                          5, kIndices + kTexNumber,
                          "3 0 1 2 2\n3 0 1 2 1\n3 0 1 2 0\n3 0 1 2 3\n"
                          "3 0 1 2 -1\n"));
  EXPECT_EQ(ply.materials.images.size(), 2U);
  EXPECT_EQ(ply.materials.image_of_material,
            (std::vector<std::optional<std::uint32_t>>{0U, 1U, 0U}));
  EXPECT_EQ(materials(ply.mesh), (Indices{2, 1, 0, kNo, kNo}));
}

TEST(PlyReader, TakesTheImageBesideTheFileIfItNamesNone) {
  const TempDir dir;
  const std::string path = dir.write("model.ply", with_faces("", 1, kIndices, "3 0 1 2\n"));
  dir.write("model.tga", "");
  const std::string image = dir.write("model.JPG", "");
  PlyReader reader(path);
  const PlyContent ply = read_ply(reader);
  ASSERT_EQ(ply.materials.images.size(), 1U);
  EXPECT_EQ(ply.materials.images[0].name, "model.JPG");
  EXPECT_EQ(ply.materials.images[0].source.path, std::filesystem::canonical(image));
  EXPECT_EQ(materials(ply.mesh), (Indices{0}));
}

TEST(PlyReader, DropsInvalidPolygonsWithTheirLines) {
  const PlyContent ply =
      read_ply(with_faces("", 5, kIndices, "2 0 1\n3 0 1 4\n3 0 -1 2\n0\n3 1 2 3\n"));
  EXPECT_EQ(vertices(ply.mesh), (Indices{1, 2, 3}));
  EXPECT_EQ(ply.mesh.invalid_polygons, 4U);
  ASSERT_EQ(ply.messages.size(), 4U);
  EXPECT_EQ(ply.messages[0], "model.ply:14: polygon dropped: it has fewer than three corners");
  EXPECT_EQ(ply.messages[1],
            "model.ply:15: polygon dropped: it names a vertex that does not exist");
}

TEST(PlyReader, WarnsAboutValuesThatAreNotFinite) {
  const PlyContent ply = read_ply(
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nproperty float s\nproperty float t\nend_header\n"
      "nan 0 0 0 0\n0 0 0 inf 0\n");
  ASSERT_EQ(ply.messages.size(), 2U);
  EXPECT_TRUE(ply.messages[0].starts_with("model.ply:10: the position is not finite"));
  EXPECT_TRUE(ply.messages[1].starts_with("model.ply:11: the texture coordinate is not finite"));
}

TEST(PlyReader, ReadsFacesBeforeVerticesAndSkipsOtherElements) {
  const PlyContent ply = read_ply(
      "ply\nformat ascii 1.0\nobj_info made by hand\nelement edge 1\nproperty int a\n"
      "property list uchar float weights\nelement empty 1000000000000000000\nelement face 1\n" +
      kIndices + kVertexHeader + "end_header\n5 3 1 1 1\n3 3 1 0\n" + kFourVertices);
  EXPECT_EQ(vertices(ply.mesh), (Indices{3, 1, 0}));
  EXPECT_EQ(ply.mesh.positions.size(), 4U);
}

TEST(PlyReader, ReadsStripsWithRestarts) {
  const PlyContent ply = read_ply("ply\nformat ascii 1.0\n" + kVertexHeader +
                                  "element tristrips 1\nproperty list int int vertex_indices\n"
                                  "end_header\n" +
                                  kFourVertices + "9 0 1 2 3 -1 3 2 1 -1\n");
  EXPECT_EQ(vertices(ply.mesh), (Indices{0, 1, 2, 2, 1, 3, 3, 2, 1}));
}

TEST(PlyReader, ReadsVerticesAloneAsAModelOfNoFaces) {
  const PlyContent ply =
      read_ply("ply\nformat ascii 1.0\n" + kVertexHeader + "end_header\n" + kFourVertices);
  EXPECT_EQ(ply.mesh.positions.size(), 4U);
  EXPECT_TRUE(ply.mesh.faces.empty());
  expect_error("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n",
               "without vertices and faces");
}

TEST(PlyReader, SkipsWhatALineHasBeyondItsRecord) {
  const PlyContent ply = read_ply(with_faces("", 2, kIndices, "3 0 1 2 9 1 1 1\n3\n 1\n 2 3\n"));
  EXPECT_EQ(vertices(ply.mesh), (Indices{0, 1, 2, 1, 2, 3}));
  ASSERT_EQ(ply.messages.size(), 1U);
  EXPECT_TRUE(ply.messages[0].starts_with("model.ply:14: the line of face has more"))
      << ply.messages[0];
}

TEST(PlyReader, TakesAllKindsOfLineEnds) {
  const std::string text = with_faces("", 1, kIndices, "3 0 1 2\n");
  for (const std::string line_end : {"\n", "\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? line_end : std::string(1, c);
    const PlyContent ply = read_ply(other, 64);
    EXPECT_EQ(vertices(ply.mesh), (Indices{0, 1, 2}));
    EXPECT_EQ(ply.mesh.positions.size(), 4U);
  }
}

TEST(PlyReader, WarnsAboutDataLeftOver) {
  const PlyContent ply = read_ply(with_faces("", 1, kIndices, "3 0 1 2\n\n \n7\n"));
  ASSERT_EQ(ply.messages.size(), 1U);
  EXPECT_TRUE(ply.messages[0].starts_with("model.ply:17: there is more"));
}

/// Appends numbers in an order of bytes.
class BinaryText {
 public:
  explicit BinaryText(std::endian order) : order_(order) {}

  template <class T>
  BinaryText& add(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (order_ != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
    text_.append(bytes, sizeof(T));
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::endian order_;
  std::string text_;
};

struct ScalarCase {
  std::string name;
  std::function<void(BinaryText&, int)> add;
};

const std::vector<ScalarCase> kScalars = {
    {"char", [](BinaryText& b, int v) { b.add(static_cast<std::int8_t>(v)); }},
    {"uchar", [](BinaryText& b, int v) { b.add(static_cast<std::uint8_t>(v)); }},
    {"short", [](BinaryText& b, int v) { b.add(static_cast<std::int16_t>(v)); }},
    {"ushort", [](BinaryText& b, int v) { b.add(static_cast<std::uint16_t>(v)); }},
    {"int", [](BinaryText& b, int v) { b.add(static_cast<std::int32_t>(v)); }},
    {"uint", [](BinaryText& b, int v) { b.add(static_cast<std::uint32_t>(v)); }},
    {"float", [](BinaryText& b, int v) { b.add(static_cast<float>(v)); }},
    {"double", [](BinaryText& b, int v) { b.add(static_cast<double>(v)); }},
};

/// Faces before vertices; all values of one type, lengths of another.
std::string binary_ply(std::endian order, const ScalarCase& values, const ScalarCase& lengths) {
  const std::string property = "property " + values.name + " ";
  const std::string list = "property list " + lengths.name + " " + values.name + " ";
  std::string text = order == std::endian::little ? "ply\nformat binary_little_endian 1.0\n"
                                                  : "ply\nformat binary_big_endian 1.0\n";
  text += "element face 2\n" + list + "vertex_index\n" + property + "extra\n" + list +
          "texcoord\nelement vertex 4\n" + property + "x\n" + property + "nx\n" + property + "y\n" +
          property + "z\nend_header\n";
  BinaryText body(order);
  const auto add_list = [&](const std::vector<int>& items) {
    lengths.add(body, static_cast<int>(items.size()));
    for (const int item : items) values.add(body, item);
  };
  add_list({3, 1, 0, 2});
  values.add(body, 99);
  add_list({});
  add_list({0, 1, 2});
  values.add(body, 99);
  add_list({1, 2, 3, 4, 5, 6});
  for (int i = 0; i < 4; ++i) {
    for (const int value : {i, 99, 10 * i, 127 - i}) values.add(body, value);
  }
  return text + body.text();
}

TEST(PlyReader, ReadsAllTypesInBothOrdersOfBytesAndAnyBlocks) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    for (const ScalarCase& values : kScalars) {
      for (const ScalarCase& lengths : kScalars) {
        if (lengths.name == "float" || lengths.name == "double") continue;
        const std::string bytes = binary_ply(order, values, lengths);
        for (const std::size_t bytes_a_read : {std::size_t{1}, std::size_t{7}, SIZE_MAX}) {
          const PlyContent ply = read_ply(bytes, 64, bytes_a_read);
          SCOPED_TRACE(values.name + " " + lengths.name);
          EXPECT_EQ(vertices(ply.mesh), (Indices{3, 1, 0, 3, 0, 2, 0, 1, 2}));
          EXPECT_EQ(texcoords(ply.mesh), (Indices{kNo, kNo, kNo, kNo, kNo, kNo, 0, 1, 2}));
          EXPECT_EQ(uvs(ply.mesh), (std::vector<float>{1, 2, 3, 4, 5, 6}));
          EXPECT_EQ(coordinates(ply.mesh),
                    (std::vector<double>{0, 0, 127, 1, 10, 126, 2, 20, 125, 3, 30, 124}));
          EXPECT_TRUE(ply.messages.empty());
        }
      }
    }
  }
}

TEST(PlyReader, TakesUnsignedIndicesBeyondTheSignedOnesForNoVertex) {
  std::string text = "ply\nformat binary_little_endian 1.0\n" + kVertexHeader +
                     "element face 1\nproperty list uchar uint vertex_indices\nend_header\n";
  BinaryText body(std::endian::little);
  for (int i = 0; i < 12; ++i) body.add(0.0F);
  body.add(std::uint8_t{3}).add(0U).add(1U).add(0x80000002U);
  EXPECT_EQ(read_ply(text + body.text()).mesh.invalid_polygons, 1U);
}

TEST(PlyReader, RefusesEveryTruncationOfAFile) {
  std::vector<std::string> files = {
      with_faces("comment TextureFile a b.png\n", 2, kTexNumber + kTexCoords + kIndices,
                 "0 6 0 0 1 0 1 1 3 0 1 2\n0 0 4 0 1 2 3"),
      binary_ply(std::endian::little, kScalars[2], kScalars[1]),
      binary_ply(std::endian::big, kScalars[7], kScalars[4])};
  for (const std::string& file : files) {
    EXPECT_NO_THROW(read_ply(file));
    // The last character of text is part of a number that is one without it too.
    for (std::size_t bytes = 0; bytes < file.size() - 1; ++bytes) {
      EXPECT_TRUE(error_of(file.substr(0, bytes)).starts_with("model.ply:")) << bytes;
    }
  }
}

TEST(PlyReader, SaysWhereAFileEnds) {
  expect_error(with_faces("", 2, kIndices, "3 0 1 2\n3 0 1"),
               "model.ply:15: found the end of the file in element face 2 of 2");
  const std::string binary = binary_ply(std::endian::little, kScalars[0], kScalars[0]);
  expect_error(binary.substr(0, binary.size() - 1),
               "at byte " + std::to_string(binary.size() - 1) + " in element vertex 4 of 4");
}

TEST(PlyReader, RefusesNumbersThatAreNone) {
  expect_error(with_faces("", 1, kIndices, "3 0 x 2\n"), "model.ply:14: found \"x\"");
  expect_error(with_faces("", 1, kIndices, "3 0 1/2 2\n"), "model.ply:14: found \"1/2\"");
  expect_error(with_faces("", 1, kIndices, "-3 0 1 2\n"),
               "model.ply:14: found a list of length -3");
  const std::string wide = "0." + std::string(600, '0') + "1";
  expect_error(with_faces("", 1, kIndices, "3 0 " + wide + " 2\n"), "found \"0.0");
}

TEST(PlyReader, NamesTheLineOfAFaultInTheHeader) {
  const std::string start = "ply\nformat ascii 1.0\n";
  const auto expect_fault = [&](const std::string& line, const std::string& part) {
    expect_error(start + line + "\nend_header\n", "model.ply:3: " + part);
  };
  expect_fault("elephant", "found \"elephant\"");
  expect_fault("element vertex", "found \"element vertex\"");
  expect_fault("element vertex -1", "found \"element vertex -1\"");
  expect_fault("element vertex 1 2", "found \"element vertex 1 2\"");
  expect_fault("property float x", "found a property before");
  expect_fault("format ascii 2.0", "found PLY version \"2.0\"");
  expect_fault("format text 1.0", "found PLY format \"text\"");
  const auto expect_property_fault = [&](const std::string& line, const std::string& part) {
    expect_error(start + "element vertex 1\n" + line + "\nend_header\n", "model.ply:4: " + part);
  };
  expect_property_fault("property long x", "found \"long\"");
  expect_property_fault("property float", "found \"property float\"");
  expect_property_fault("property list float int x", "found a list whose length");
  expect_property_fault("element vertex 1", "found element \"vertex\" twice");
  expect_error(start + "element vertex 1\nproperty float x\nend_header\n0\n",
               "model.ply:3: found element vertex without a number y");
  expect_error(start + "element face 1\nproperty int vertex_indices\nend_header\n0\n",
               "model.ply:3: found element face without a list");
  expect_error("ply\nend_header\n", "before its format");
  expect_error("plyformat", "found no PLY file");
  expect_error("", "found no PLY file");
}

TEST(PlyReader, RefusesMoreVerticesThanAModelMayHave) {
  const std::string error = error_of(
      "ply\nformat ascii 1.0\nelement vertex 1073741824\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n",
      ErrorKind::kResource);
  EXPECT_NE(error.find("more than 1073741823 positions"), std::string::npos) << error;
}

/// "0 1 2 3 0 1 ..."
std::string many_indices(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += ' ' + std::to_string(i % 4);
  return text;
}

std::string many_texcoords(int corners) {
  std::string text;
  for (int i = 0; i < corners; ++i) text += ' ' + std::to_string(i) + " 0.5";
  return text;
}

const std::string kLongIndices = "property list int int vertex_indices\n";
const std::string kLongTexCoords = "property list int float texcoord\n";

TEST(PlyReader, HandsOutAPolygonOfAnyLengthWithItsTexCoordsOnEitherSide) {
  constexpr int kCorners = 10000;
  const std::string indices = std::to_string(kCorners) + many_indices(kCorners);
  const std::string texcoords = std::to_string(2 * kCorners) + many_texcoords(kCorners);
  for (const bool is_behind : {false, true}) {
    const PlyContent ply = read_ply(
        is_behind ? with_faces("", 1, kLongIndices + kLongTexCoords, indices + " " + texcoords)
                  : with_faces("", 1, kLongTexCoords + kLongIndices, texcoords + " " + indices),
        64);
    ASSERT_EQ(ply.mesh.faces.size(), kCorners - 2U);
    ASSERT_EQ(ply.mesh.texcoords.size(), std::size_t{kCorners});
    const FaceRecord& face = ply.mesh.faces[7000];
    EXPECT_EQ(raw(face.v[0]), 0U);
    EXPECT_EQ(raw(face.v[1]), 7001U % 4);
    EXPECT_EQ(raw(face.v[2]), 7002U % 4);
    EXPECT_EQ(raw(face.t[0]), 0U);
    EXPECT_EQ(raw(face.t[1]), 7001U);
    EXPECT_EQ(raw(face.t[2]), 7002U);
    EXPECT_EQ(ply.mesh.texcoords[7001].u, 7001.0F);
  }
}

TEST(PlyReader, WithdrawsALongPolygonThatNamesNoVertexInTheEnd) {
  const PlyContent ply =
      read_ply(with_faces("", 2, kLongIndices, "5001" + many_indices(5000) + " 4\n3 0 1 2\n"));
  ASSERT_EQ(ply.mesh.forward.size(), 1U);
  EXPECT_EQ(ply.mesh.forward[0].first_face, 0U);
  EXPECT_EQ(ply.mesh.forward[0].face_count, 4998U);
  EXPECT_EQ(ply.mesh.forward[0].max_vertex, UINT64_MAX);
  EXPECT_EQ(ply.mesh.invalid_polygons, 0U);
  CollectSink mesh = ply.mesh;
  mesh.drop_unresolved();
  EXPECT_EQ(vertices(mesh), (Indices{0, 1, 2}));
}

TEST(PlyReader, RefusesALongPolygonWhoseMaterialOrTexCoordsComeTooLate) {
  const std::string indices = "5000" + many_indices(5000);
  expect_error(
      with_faces("comment TextureFile a.png\n", 1, kLongIndices + kTexNumber, indices + " 0\n"),
      "found polygon 1 of 5000 corners with its texnumber behind");
  expect_error(with_faces("", 1, kLongIndices + kLongTexCoords, indices + " 2 0 0\n"),
               "with 2 values in its list texcoord");
  EXPECT_NO_THROW(read_ply(with_faces("", 1, kLongIndices + kTexNumber, indices + " 0\n")));
}

TEST(PlyReader, ReadsCompressedFiles) {
  const TempDir dir;
  const std::string text = with_faces("", 1, kIndices, "3 0 1 2\n");
  PlyReader reader(dir.write("model.ply.gz", gzip(text)));
  EXPECT_EQ(vertices(read_ply(reader).mesh), (Indices{0, 1, 2}));
}

TEST(PlyReader, RefusesAFileThatIsNotThere) {
  EXPECT_THROW(PlyReader("/nowhere/model.ply"), Error);
}

// The models beside the checkout.

std::string shared_file(const std::string& name) {
  return (shared_folder() / "data" / name).string();
}

PlyContent read_ply_file(const std::string& name, std::size_t block_bytes) {
  PlyReader reader(shared_file(name), block_bytes);
  return read_ply(reader);
}

ObjContent read_obj_file(const std::string& name) {
  const auto source = open_byte_source(shared_file(name));
  return read_obj(*source);
}

/// Position and texture coordinate of every corner, as floats.
std::vector<std::vector<float>> corners_of(const CollectSink& mesh) {
  std::vector<std::vector<float>> corners;
  for (const FaceRecord& face : mesh.faces) {
    for (int i = 0; i < 3; ++i) {
      const Position& p = mesh.positions[raw(face.v[i])];
      const TexCoord& t = mesh.texcoords[raw(face.t[i])];
      corners.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), t.u, t.v});
    }
  }
  return corners;
}

class SharedPly : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(shared_folder() / "data")) {
      GTEST_SKIP() << "NOTE: no models beside this checkout, nothing is compared";
    }
  }
};

TEST_F(SharedPly, EqualsItsTwinInObj) {
  const auto obj = corners_of(read_obj_file("draco/cube_att.obj").mesh);
  EXPECT_EQ(corners_of(read_ply_file("draco/cube_att.ply", 64).mesh), obj);
}

TEST_F(SharedPly, IsTheSameInTextAndBinary) {
  const PlyContent text = read_ply_file("trimesh/fuze_ascii.ply", 64);
  const PlyContent binary = read_ply_file("trimesh/fuze.ply", 64);
  EXPECT_EQ(text.mesh.faces.size(), 1000U);
  EXPECT_EQ(text.mesh.texcoords.size(), 3000U);
  EXPECT_EQ(vertices(text.mesh), vertices(binary.mesh));
  EXPECT_EQ(binary.materials.images.at(0).name, "fuze uv.jpg");
  EXPECT_EQ(text.materials.images.at(0).source.path, binary.materials.images.at(0).source.path);
  EXPECT_EQ(text.messages.size(), 6U) << "every line of a face has nine colours too many";
  const auto a = corners_of(text.mesh);
  const auto b = corners_of(binary.mesh);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < 5; ++k) ASSERT_NEAR(a[i][k], b[i][k], 1e-6) << i;
  }
}

TEST_F(SharedPly, HasTheTexCoordsOfItsVertices) {
  for (const char* const name : {"trimesh/BoxTextured.ply", "trimesh/cube_blender_uv.ply"}) {
    const PlyContent ply = read_ply_file(name, 1 << 16);
    EXPECT_EQ(ply.mesh.positions.size(), 24U);
    EXPECT_EQ(ply.mesh.texcoords.size(), 24U);
    EXPECT_EQ(ply.mesh.faces.size(), 12U);
    EXPECT_EQ(vertices(ply.mesh), texcoords(ply.mesh));
    EXPECT_TRUE(ply.messages.empty());
  }
}

}  // namespace
}  // namespace atlasgauge
