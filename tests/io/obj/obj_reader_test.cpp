#include "io/obj/obj_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "tests/support/obj_text.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint32_t kNo = raw(kNone<TexCoordId>);
const std::string kFourVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kFourTexCoords = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

using Indices = std::vector<std::uint32_t>;

/// Vertices of all faces, one after the other.
Indices vertices(const ObjContent& obj) {
  Indices result;
  for (const FaceRecord& face : obj.mesh.faces) {
    for (const VertexId v : face.v) result.push_back(raw(v));
  }
  return result;
}

Indices texcoords(const ObjContent& obj) {
  Indices result;
  for (const FaceRecord& face : obj.mesh.faces) {
    for (const TexCoordId t : face.t) result.push_back(raw(t));
  }
  return result;
}

Indices materials(const ObjContent& obj) {
  Indices result;
  for (const FaceRecord& face : obj.mesh.faces) result.push_back(raw(face.material));
  return result;
}

/// The message of the error that reading a text ends in, empty if none.
std::string error_of(const std::string& text, std::size_t block_bytes = 1 << 16) {
  try {
    read_obj(text, block_bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    return error.what();
  }
  return "";
}

/// Everything a driver sees once the whole file is read, as text.
std::string story_of(ObjContent obj) {
  std::string story;
  const std::uint64_t dropped = obj.mesh.drop_unresolved();
  for (const Position& p : obj.mesh.positions) {
    story += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  for (const TexCoord& t : obj.mesh.texcoords) {
    story += std::to_string(t.u) + " " + std::to_string(t.v) + "\n";
  }
  for (const Indices& indices : {vertices(obj), texcoords(obj), materials(obj)}) {
    for (const std::uint32_t index : indices) story += std::to_string(index) + " ";
    story += "\n";
  }
  const ObjSummary& summary = obj.summary;
  for (const std::uint64_t count :
       {summary.positions, summary.texcoords, summary.invalid_polygons + dropped,
        summary.skipped_primitives, summary.unknown_statements}) {
    story += std::to_string(count) + " ";
  }
  for (const std::string& name : summary.material_names) story += "[" + name + "]";
  for (const std::string& line : summary.mtllib_lines) story += "{" + line + "}";
  return story;
}

std::string story_or_error(const std::string& text, std::size_t block_bytes) {
  try {
    return story_of(read_obj(text, block_bytes));
  } catch (const Error& error) {
    return error.what();
  }
}

/// A bit of everything.
const std::string kZoo =
    "# a comment that goes on \\\n and on\n"
    "mtllib  some file.mtl other.mtl  # libraries\n"
    "mtllib some file.mtl other.mtl\r\n"
    "v 0 0 0 1.0\n v 1 0 0 0.5 0.5 0.5 1\n\tv\t1 1 0\nv 0 \\\n 1 \\\r\n -0\n"
    "vt 0.5 -0.25 0.125\nvt 1\nvn 0 0 1\nvt .5 .75\r\nvt 0 1\n"
    "f 1/1 2/2 3/3\n"
    "usemtl first material \n"
    "f 1/1/1 2//1 3/3/x 4\n"
    "f -4/-4 -3/-3 -2/-9 # the last names nothing\n"
    "usemtl\tsecond\n"
    "o object\ng group one\ns off\nl 1 2\np 1 2 3\nwhatever 1 2 3\n"
    "f 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 5\n"
    "f 0 1 2\nf 1 2\nf 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 0 1 2 3 4\n"
    "f 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 4 6\n"
    "f -1 -2 -9\nusemtl first material\nf 99999999999999999999 1 2\nf 1/99999999999 2/0 3/5\n"
    "v 5 5 5 \nvt inf nan\nf -1 -2 -3\nf 5 4 3\nf 6 1 2\n"
    "usemtl a name that is so long that it fills more than one small block, and goes on   \n"
    "f 1 2 3";

TEST(ObjReaderTest, ReadsPositionsTexCoordsAndFaces) {
  const ObjContent obj = read_obj("v 1 2 3\nv -1.5 .5 2e1\nv 0 0 0\nvt 0.25 0.75\nf 1/1 2/1 3/1\n");
  ASSERT_EQ(obj.mesh.positions.size(), 3U);
  EXPECT_EQ(obj.mesh.positions[1].x, -1.5);
  EXPECT_EQ(obj.mesh.positions[1].z, 20.0);
  ASSERT_EQ(obj.mesh.texcoords.size(), 1U);
  EXPECT_EQ(obj.mesh.texcoords[0].v, 0.75F);
  EXPECT_EQ(vertices(obj), (Indices{0, 1, 2}));
  EXPECT_EQ(texcoords(obj), (Indices{0, 0, 0}));
  EXPECT_EQ(materials(obj), (Indices{raw(kNone<MaterialId>)}));
  EXPECT_EQ(obj.summary.faces, 1U);
  EXPECT_TRUE(obj.messages.empty());
}

TEST(ObjReaderTest, AFileWithNothingOfAModelIsRefused) {
  for (const char* text : {"", "\n\n \r\n", "# a comment\n", "newmtl a\nKd 1 1 1\n", "o a\n"}) {
    EXPECT_NE(error_of(text).find("no statement of a Wavefront OBJ"), std::string::npos) << text;
  }
}

TEST(ObjReaderTest, AModelWithoutFacesIsAModel) {
  for (const char* text :
       {"v 0 0 0\n", "vt 0 0\n", "f 1 2 3\n", "p 1\n", "usemtl a\n", "mtllib a\n"}) {
    EXPECT_EQ(error_of(text), "") << text;
  }
}

TEST(ObjReaderTest, EveryBlockSizeGivesTheSameOutput) {
  const std::string expected = story_of(read_obj(kZoo));
  EXPECT_NE(expected.find("[first material][second]"), std::string::npos);
  for (std::size_t block_bytes = 64; block_bytes < kZoo.size() + 10; ++block_bytes) {
    ASSERT_EQ(story_of(read_obj(kZoo, block_bytes)), expected) << block_bytes;
  }
}

TEST(ObjReaderTest, ShortReadsGiveTheSameOutput) {
  const std::string expected = story_of(read_obj(kZoo));
  for (const std::size_t bytes_a_read : {1U, 2U, 3U, 64U, 65U}) {
    TextSource source(kZoo, bytes_a_read);
    EXPECT_EQ(story_of(read_obj(source, 100)), expected);
  }
}

TEST(ObjReaderTest, LineEndsOfWindowsChangeNothing) {
  std::string text;
  for (const char c : kZoo) {
    if (c != '\r') text += c == '\n' ? "\r\n" : std::string(1, c);
  }
  EXPECT_EQ(story_of(read_obj(text)), story_of(read_obj(kZoo)));
  EXPECT_EQ(story_of(read_obj(text, 64)), story_of(read_obj(kZoo)));
}

TEST(ObjReaderTest, AFileCutAnywhereGivesValuesOrAnError) {
  for (std::size_t bytes = 0; bytes <= kZoo.size(); ++bytes) {
    const std::string text = kZoo.substr(0, bytes);
    const std::string whole = story_or_error(text, 1 << 16);
    EXPECT_FALSE(whole.empty());
    ASSERT_EQ(story_or_error(text, 64), whole) << bytes;
    ASSERT_EQ(story_or_error(text, 71), whole) << bytes;
  }
}

TEST(ObjReaderTest, AnyBytesGiveValuesOrAnErrorForEveryBlockSize) {
  std::mt19937 random(11);
  const std::string alphabet = "vtfn0123456789.-+/# \\\r\n\v\tusemtlib\xFF" + std::string(1, '\0');
  for (int round = 0; round < 3000; ++round) {
    std::string text;
    for (std::size_t i = 0; i < 300; ++i) text += alphabet[random() % alphabet.size()];
    const std::string whole = story_or_error(text, 1 << 12);
    ASSERT_EQ(story_or_error(text, 64 + random() % 100), whole) << text;
  }
}

TEST(ObjReaderTest, DamagedFilesGiveTheSameForEveryBlockSize) {
  std::mt19937 random(12);
  const std::string alphabet("vf1/#\\\n -x");
  for (int round = 0; round < 3000; ++round) {
    std::string text = kZoo;
    for (int i = 0; i < 3; ++i) text[random() % text.size()] = alphabet[random() % alphabet.size()];
    const std::string whole = story_or_error(text, 1 << 12);
    ASSERT_EQ(story_or_error(text, 64 + random() % 100), whole) << text;
  }
}

TEST(ObjReaderTest, DenseTextDoesNotOutgrowABlock) {
  std::string text = kFourVertices;
  for (int i = 0; i < 2000; ++i) text += "f 1 2 3 4 1 2 3 4 1\n";
  for (int i = 0; i < 2000; ++i) text += "v 1 2 3\nvt 1\nusemtl\nmtllib\nf 1 2\nx\n";
  const std::string expected = story_of(read_obj(text, 1 << 20));
  EXPECT_EQ(read_obj(text, 1 << 20).mesh.faces.size(), 14000U);
  EXPECT_EQ(story_of(read_obj(text, 512)), expected);
  EXPECT_EQ(story_of(read_obj(text, 4096)), expected);
}

TEST(ObjReaderTest, PolygonsBecomeFans) {
  const ObjContent obj = read_obj(kFourVertices + "v 2 2 2\nf 1 2 3 4 5\n");
  EXPECT_EQ(vertices(obj), (Indices{0, 1, 2, 0, 2, 3, 0, 3, 4}));
}

TEST(ObjReaderTest, APolygonOfManyBlocksBecomesAFan) {
  std::string text = kFourVertices + kFourTexCoords + "usemtl m\nf";
  const std::uint32_t corners = 100000;
  for (std::uint32_t i = 0; i < corners; ++i) text += " " + std::to_string(1 + i % 4) + "/-1";
  const ObjContent obj = read_obj(text + "\nf 1 2 3\n", 256);
  ASSERT_EQ(obj.mesh.faces.size(), corners - 1);
  EXPECT_EQ(raw(obj.mesh.faces[1000].v[0]), 0U);
  EXPECT_EQ(raw(obj.mesh.faces[1000].v[1]), 1001U % 4);
  EXPECT_EQ(raw(obj.mesh.faces[1000].v[2]), 1002U % 4);
  EXPECT_EQ(raw(obj.mesh.faces[1000].t[2]), 3U);
  EXPECT_EQ(raw(obj.mesh.faces[1000].material), 0U);
  EXPECT_TRUE(obj.mesh.forward.empty());
}

TEST(ObjReaderTest, ABadCornerLateInALongPolygonWithdrawsIt) {
  std::string text = kFourVertices + "f 1 2 3\nf";
  for (int i = 0; i < 1000; ++i) text += " 1 2 3";
  const ObjContent obj = read_obj(text + " 0\nf 4 3 2\n", 128);
  ASSERT_EQ(obj.mesh.forward.size(), 1U);
  EXPECT_EQ(obj.mesh.forward[0].first_face, 1U);
  EXPECT_EQ(obj.mesh.forward[0].face_count, 2998U);
  EXPECT_EQ(obj.mesh.forward[0].max_vertex, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(obj.mesh.forward[0].line, 6U);
  EXPECT_EQ(raw(obj.mesh.faces.back().v[0]), 3U);
}

TEST(ObjReaderTest, LongLinesOfOtherStatementsAreRead) {
  const std::string blanks(5000, ' ');
  const std::string words = " 7 8 9" + blanks + "x y z";
  const std::string text = "v 1" + blanks + "2 3" + words + "\nvt" + blanks + ".5" + words +
                           "\nvn" + words + "\n#" + words + "\nusemtl" + blanks + "a  b" + blanks +
                           "\ng" + words + "\nwhat" + words + "\nl" + words + "\n" + blanks + "\n";
  const ObjContent obj = read_obj(text, 100);
  ASSERT_EQ(obj.mesh.positions.size(), 1U);
  EXPECT_EQ(obj.mesh.positions[0].z, 3.0);
  ASSERT_EQ(obj.mesh.texcoords.size(), 1U);
  EXPECT_EQ(obj.mesh.texcoords[0].u, 0.5F);
  EXPECT_EQ(obj.mesh.texcoords[0].v, 7.0F);
  EXPECT_EQ(obj.summary.material_names, std::vector<std::string>{"a  b"});
  EXPECT_EQ(obj.summary.unknown_statements, 1U);
  EXPECT_EQ(obj.summary.skipped_primitives, 1U);
  EXPECT_EQ(story_of(read_obj(text)), story_of(read_obj(text, 100)));
}

TEST(ObjReaderTest, OverlongNamesAndWordsAreErrorsForEveryBlockSize) {
  const std::string longest(kMaxWordBytes, 'n');
  for (const std::size_t block_bytes : {64U, 1000U, 1U << 20}) {
    EXPECT_EQ(read_obj("usemtl " + longest + "\n", block_bytes).summary.material_names[0], longest);
    EXPECT_NE(error_of("\nusemtl n" + longest, block_bytes).find("model.obj:2:"),
              std::string::npos);
    EXPECT_NE(error_of("mtllib n" + longest, block_bytes).find("file name"), std::string::npos);
    EXPECT_NE(error_of("v 1 2 3 4" + longest, block_bytes).find("a word"), std::string::npos);
    EXPECT_NE(error_of("f 1 2//" + longest, block_bytes).find("a word"), std::string::npos);
    EXPECT_EQ(error_of("p 1\ng n" + longest + "\n#" + longest + longest, block_bytes), "");
    EXPECT_EQ(error_of("v 1 2 3 #" + longest + longest, block_bytes), "");
  }
}

TEST(ObjReaderTest, NegativeIndicesCountFromWhatWasReadSoFar) {
  const ObjContent obj = read_obj(kFourVertices + kFourTexCoords +
                                  "f -4/-1 -3/-2 -2/-3\nv 9 9 9\nvt 9 9\nf -1/-1 -2 1/1\n");
  EXPECT_EQ(vertices(obj), (Indices{0, 1, 2, 4, 3, 0}));
  EXPECT_EQ(texcoords(obj), (Indices{3, 2, 1, 4, kNo, 0}));
}

TEST(ObjReaderTest, NegativeIndicesReachBackBeyondTheBlock) {
  const std::string filler(200, '#');
  const ObjContent obj = read_obj(kFourVertices + filler + "\n" + filler + "\nf -4 -3 -2 -1\n", 64);
  EXPECT_EQ(vertices(obj), (Indices{0, 1, 2, 0, 2, 3}));
}

TEST(ObjReaderTest, PolygonsThatNameNoVertexAreDroppedWithTheirLine) {
  const ObjContent obj = read_obj(kFourVertices + "f 0 1 2\nf 1 2 3\nf -5 1 2\nf 1 2\nf\n" +
                                  "f 99999999999999999999999 1 2\nf 1 2 4\n");
  EXPECT_EQ(vertices(obj), (Indices{0, 1, 2, 0, 1, 3}));
  EXPECT_EQ(obj.summary.invalid_polygons, 5U);
  ASSERT_EQ(obj.messages.size(), 6U);
  EXPECT_EQ(obj.messages[0].find("model.obj:5: "), 0U);
  EXPECT_EQ(obj.messages[1].find("model.obj:7: "), 0U);
  EXPECT_EQ(obj.messages[2].find("model.obj:8: "), 0U);
  EXPECT_EQ(obj.messages[4].find("model.obj:10: "), 0U);
}

TEST(ObjReaderTest, MaterialsStayWithTheirFacesWhenPolygonsAreDropped) {
  const ObjContent obj =
      read_obj(kFourVertices +
               "f 1 2 3\nusemtl a\nf -9 1 2\nusemtl b\nf 2 3 4 1\nf -9 -8 -7 -6\n"
               "usemtl a\nf -1 -2 -3\nusemtl c\n");
  EXPECT_EQ(materials(obj), (Indices{raw(kNone<MaterialId>), 1, 1, 0}));
  EXPECT_EQ(obj.summary.material_names, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(obj.summary.invalid_polygons, 2U);
}

TEST(ObjReaderTest, StrictMakesTheFirstWarningAnError) {
  EXPECT_THROW(read_obj(kFourVertices + "f 0 1 2\n", 1 << 16, true), Error);
}

TEST(ObjReaderTest, CoordinatesThatAreNotFiniteWarnWithTheirLine) {
  const std::string blanks(100, ' ');
  const std::string text = "v 1 2 3\nv 1 nan 3\nvt inf\nvt 0 0\nvt 0 " + blanks + "1e99\nv " +
                           blanks + "1e999 0 0\nv 1 1 1 nan\n";
  for (const std::size_t block_bytes : {64U, 1U << 16}) {
    const ObjContent obj = read_obj(text, block_bytes);
    ASSERT_EQ(obj.messages.size(), 4U);
    EXPECT_TRUE(obj.messages[0].starts_with("model.obj:2: the position is not finite"));
    EXPECT_TRUE(obj.messages[1].starts_with("model.obj:3: the texture coordinate is not finite"));
    EXPECT_TRUE(obj.messages[2].starts_with("model.obj:5: the texture coordinate"));
    EXPECT_TRUE(obj.messages[3].starts_with("model.obj:6: the position"));
    EXPECT_EQ(obj.mesh.positions.size(), 4U);
    EXPECT_EQ(obj.summary.invalid_polygons, 0U);
  }
  EXPECT_THROW(read_obj("v 0 0 nan\n", 1 << 16, true), Error);
  EXPECT_THROW(read_obj("vt nan\n", 1 << 16, true), Error);
}

TEST(ObjReaderTest, ForwardReferencesAreHandedOnOnlyBeyondTheBlock) {
  EXPECT_TRUE(read_obj("f 1 2 3\n" + kFourVertices).mesh.forward.empty());
  const std::string filler(100, '#');
  const ObjContent obj = read_obj("f 1 2 3\nf 1 2 3 9\n" + filler + "\n" + kFourVertices, 64);
  ASSERT_EQ(obj.mesh.forward.size(), 2U);
  EXPECT_EQ(obj.mesh.forward[0].max_vertex, 2U);
  EXPECT_EQ(obj.mesh.forward[1].first_face, 1U);
  EXPECT_EQ(obj.mesh.forward[1].face_count, 2U);
  EXPECT_EQ(obj.mesh.forward[1].max_vertex, 8U);
  EXPECT_EQ(obj.mesh.forward[1].line, 2U);
  EXPECT_EQ(obj.summary.invalid_polygons, 0U);
}

TEST(ObjReaderTest, TextureIndicesThatNameNothingMeanNoUv) {
  const ObjContent obj = read_obj(
      kFourVertices + kFourTexCoords +
      "f 1/0 2/-5 3/99999999999999999999\nf 1/ 2// 3//7\nf 1/4294967295 2/4294967296 3/77\n");
  EXPECT_EQ(texcoords(obj), (Indices{kNo, kNo, kNo, kNo, kNo, kNo, 4294967294U, kNo, 76}));
}

TEST(ObjReaderTest, NormalIndicesAreNotRead) {
  const ObjContent obj =
      read_obj(kFourVertices + kFourTexCoords + "f 1/1/x 2/2/99999999999999999999 3//-\n");
  EXPECT_EQ(vertices(obj), (Indices{0, 1, 2}));
  EXPECT_EQ(texcoords(obj), (Indices{0, 1, kNo}));
}

TEST(ObjReaderTest, UnreadableNumbersAreErrorsWithTheirLine) {
  for (const char* line : {"f 1/x 2 3", "v 1 2", "v a b c", "v", "v 1 2 3x", "vt", "vt x", "vt 1 x",
                           "vt # 1", "f 1 2 x", "f 1.5 2 3", "f 1/2x 1 1", "f /1 2 3", "v 1 2 #3",
                           "f a", "v 3.1+e2 0 0", "v 1 2 1e"}) {
    for (const std::size_t block_bytes : {64U, 1U << 16}) {
      const std::string text = "# one\nv 0 0 0\n" + std::string(line) + "\nf 1 1 1\n";
      EXPECT_EQ(error_of(text, block_bytes).find("model.obj:3: found "), 0U) << line;
    }
    const std::string long_line = line + std::string(200, ' ') + "\n";
    EXPECT_EQ(error_of("# one\nv 0 0 0\n" + long_line, 64).find("model.obj:3: found "), 0U) << line;
  }
}

TEST(ObjReaderTest, ErrorsNameTheWordThatWasFound) {
  EXPECT_NE(error_of("v 1 bad 3").find("found \"bad\""), std::string::npos);
  EXPECT_NE(error_of("v 1").find("found the end of the line"), std::string::npos);
  EXPECT_NE(error_of("f 1 2 b\x01 d").find("found \"b\\x01\""), std::string::npos);
}

TEST(ObjReaderTest, LinesAreCountedAcrossContinuationsAndBlocks) {
  const std::string text = "v 0 \\\n 0 \\\r\n 0\n# c \\\n c\n\nv x 0 0\n";
  EXPECT_EQ(error_of(text).find("model.obj:7:"), 0U);
  std::string long_text;
  for (int i = 0; i < 100; ++i) long_text += text.substr(0, text.find("v x"));
  EXPECT_EQ(error_of(long_text + "v x", 64).find("model.obj:601:"), 0U);
}

TEST(ObjReaderTest, ABackslashContinuesAnyLineAndSeparatesWords) {
  const ObjContent obj = read_obj("v 1 2\\\n3\n# comment \\\nv 9 9 9\n");
  ASSERT_EQ(obj.mesh.positions.size(), 1U);
  EXPECT_EQ(obj.mesh.positions[0].z, 3.0);
}

TEST(ObjReaderTest, ABackslashInsideALineIsAnOrdinaryCharacter) {
  EXPECT_EQ(read_obj("usemtl a\\b\\ \nv 1 2 3\n").summary.material_names[0], "a\\b\\");
  EXPECT_EQ(read_obj("usemtl a\\").summary.material_names[0], "a");
}

TEST(ObjReaderTest, CommentsBeginAtWords) {
  const ObjContent obj = read_obj("usemtl a#b # c\nv 1 2 3 # 4\nvt 0.5 # 7\n  # v 1\n#v 1\n");
  EXPECT_EQ(obj.summary.material_names[0], "a#b");
  EXPECT_EQ(obj.mesh.texcoords[0].v, 0.0F);
  EXPECT_EQ(obj.mesh.positions.size(), 1U);
}

TEST(ObjReaderTest, ExtraNumbersOfPositionsAreNotRead) {
  const ObjContent obj = read_obj("v 1 2 3 1.0\nv 1 2 3 .1 .2 .3\nv 1 2 3 x y z w\n");
  EXPECT_EQ(obj.mesh.positions.size(), 3U);
}

TEST(ObjReaderTest, NonFiniteValuesArePassedOn) {
  const ObjContent obj = read_obj("v nan inf -1.#INF\nvt 1.#QNAN 1e999\n");
  EXPECT_TRUE(std::isnan(obj.mesh.positions[0].x));
  EXPECT_TRUE(std::isinf(obj.mesh.positions[0].z));
  EXPECT_TRUE(std::isnan(obj.mesh.texcoords[0].u));
  EXPECT_TRUE(std::isinf(obj.mesh.texcoords[0].v));
}

TEST(ObjReaderTest, NegativeZerosBecomeZeros) {
  const ObjContent obj = read_obj("v -0 -0.0 -1e-999\nvt -0 -0.0\n");
  EXPECT_FALSE(std::signbit(obj.mesh.positions[0].x));
  EXPECT_FALSE(std::signbit(obj.mesh.positions[0].z));
  EXPECT_FALSE(std::signbit(obj.mesh.texcoords[0].u));
  EXPECT_FALSE(std::signbit(obj.mesh.texcoords[0].v));
}

TEST(ObjReaderTest, MaterialsAreNumberedInOrderOfFirstUse) {
  const ObjContent obj = read_obj(kFourVertices +
                                  "usemtl b c \nf 1 2 3\nusemtl a\nf 1 2 3\nusemtl  b c\nf 1 2 3\n"
                                  "usemtl\nf 1 2 3\n");
  EXPECT_EQ(materials(obj), (Indices{0, 1, 0, 2}));
  EXPECT_EQ(obj.summary.material_names, (std::vector<std::string>{"b c", "a", ""}));
}

TEST(ObjReaderTest, LibraryLinesAreKeptWholeAndOnce) {
  const ObjContent obj = read_obj("mtllib a b.mtl  c.mtl \nmtllib d.mtl\nmtllib a b.mtl  c.mtl\n");
  EXPECT_EQ(obj.summary.mtllib_lines, (std::vector<std::string>{"a b.mtl  c.mtl", "d.mtl"}));
}

TEST(ObjReaderTest, KnownStatementsAreSilentAndUnknownOnesWarn) {
  const ObjContent obj = read_obj(
      "o a\ng b\ns 1\nmg 1 2\nvn 0 0 1\nvp 1 2\nl 1 2\np 1\ncurv 0 1 1\nsurf 0 1 0 1 1\nend\n"
      "cstype bezier\nfoo 1\nV 1 2 3\n");
  EXPECT_EQ(obj.summary.skipped_primitives, 4U);
  EXPECT_EQ(obj.summary.unknown_statements, 2U);
  ASSERT_EQ(obj.messages.size(), 2U);
  EXPECT_EQ(obj.messages[0], "model.obj:13: statement \"foo\" is unknown and ignored");
}

TEST(ObjReaderTest, WarningsAreCountedBeyondTheFirstFew) {
  std::string text = kFourVertices;
  for (int i = 0; i < 100; ++i) text += "f 0 1 2\nfoo\n";
  for (const std::size_t block_bytes : {64U, 1U << 16}) {
    const ObjContent obj = read_obj(text, block_bytes);
    EXPECT_EQ(obj.summary.invalid_polygons, 100U);
    EXPECT_EQ(obj.summary.unknown_statements, 100U);
    EXPECT_EQ(obj.messages.size(), 12U);
  }
}

TEST(ObjReaderTest, AUtf8MarkIsSkipped) {
  EXPECT_EQ(read_obj("\xEF\xBB\xBFv 1 2 3\n").mesh.positions.size(), 1U);
  EXPECT_NE(error_of("\xEF\xBB\xBF").find("no statement"), std::string::npos);
}

TEST(ObjReaderTest, Utf16AndBinaryFilesAreErrorsThatSaySo) {
  using std::string_literals::operator""s;
  EXPECT_NE(error_of("\xFF\xFEv\0 \0"s).find("UTF-16"), std::string::npos);
  EXPECT_NE(error_of("\xFE\xFF\0v\0 "s).find("UTF-16"), std::string::npos);
  EXPECT_NE(error_of("v\0 \0001\0\n\0"s).find("binary"), std::string::npos);
  EXPECT_NE(error_of("glTF\2\0\0\0 and so on"s).find("binary"), std::string::npos);
  EXPECT_NE(error_of("v 1\0 2 3"s).find("binary"), std::string::npos);
  EXPECT_NE(error_of("glTF " + std::string(500, 'x') + "\0"s, 64).find("binary"),
            std::string::npos);
}

TEST(ObjReaderTest, AZeroByteInACommentIsNoReasonForAnError) {
  const std::string text = "v 1 2 #" + std::string(100, '\0');
  for (const std::size_t block_bytes : {64U, 1U << 16}) {
    EXPECT_NE(error_of(text, block_bytes).find("found the end of the line"), std::string::npos);
  }
}

TEST(ObjReaderTest, ABlockStaysWithinItsStatedMemory) {
  EXPECT_LT(ObjReader::memory_bytes(4 << 20), 7U * (4 << 20));
  EXPECT_GT(ObjReader::memory_bytes(4 << 20), std::size_t{4} << 20);
}

TEST(ObjReaderTest, BlocksAreReadAheadWhileOthersAreCommitted) {
  std::string text = kFourVertices;
  for (int i = 0; i < 1000; ++i) text += "f -1 -2 -3\nv 1 1 1\n";
  TextSource source(text);
  Warnings warnings(nullptr);
  ObjReader reader(source, "model.obj", warnings, 128);
  std::vector<ObjBlock> blocks(200);
  std::size_t count = 0;
  while (count < blocks.size() && reader.next(blocks[count])) ++count;
  ASSERT_LT(count, blocks.size());
  for (std::size_t i = count; i-- > 0;) reader.parse(blocks[i]);
  CollectSink sink;
  for (std::size_t i = 0; i < count; ++i) reader.commit(blocks[i], sink);
  EXPECT_EQ(sink.faces.size(), 1000U);
  EXPECT_EQ(raw(sink.faces.back().v[0]), 1002U);
}

}  // namespace
}  // namespace atlasgauge
