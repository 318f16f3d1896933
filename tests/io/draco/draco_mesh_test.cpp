#include "io/draco/draco_mesh.hpp"

#include <draco/compression/decode.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "tests/support/draco_stream.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/shared_folder.hpp"

namespace atlasgauge {
namespace {

const std::string kPath = "model.drc";

DracoMesh decode(const std::string& stream, const DracoAttributes& attributes = {}) {
  return DracoMesh::decode(stream, attributes, kPath);
}

/// What kind of error that is thrown, and its text; empty for none.
std::string error_of(const std::function<void()>& action, ErrorKind kind = ErrorKind::kInput) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "";
}

const std::vector<DracoEncoding> kEncodings = {
    {true, 0, 16, 14}, {true, 5, 11, 0},   {true, 10, 16, 14},
    {true, 5, 0, 0},   {false, 0, 16, 14}, {false, 10, 0, 0},
};

TEST(DracoHeader, KnowsTheCountsOfAMesh) {
  for (const DracoEncoding& encoding : kEncodings) {
    const std::string stream = encode_draco(*DracoGrid{.cells = 10}.mesh(), encoding);
    const DracoHeader header = read_draco_header(stream.substr(0, 256), stream.size(), kPath);
    EXPECT_TRUE(header.is_mesh);
    EXPECT_EQ(header.is_edgebreaker, encoding.edgebreaker);
    EXPECT_EQ(header.major_version, 2);
    EXPECT_EQ(header.minor_version, 2);
    EXPECT_EQ(header.counts.faces, 200U);
    EXPECT_EQ(header.counts.positions, 121U);
    EXPECT_EQ(header.begin_bytes_needed, 0U);
  }
}

TEST(DracoHeader, AsksForMoreWhereMetadataStandBeforeTheCounts) {
  const std::unique_ptr<draco::Mesh> mesh = DracoGrid{.has_materials = true}.mesh();
  auto metadata = std::make_unique<draco::GeometryMetadata>();
  auto below = std::make_unique<draco::Metadata>();
  below->AddEntryString("text", std::string(3000, 'x'));
  below->AddSubMetadata("deeper", std::make_unique<draco::Metadata>(*below));
  metadata->AddSubMetadata("below", std::move(below));
  metadata->AddEntryInt("number", 7);
  mesh->AddMetadata(std::move(metadata));
  const std::string stream = encode_draco(*mesh, {});
  std::size_t bytes = 256;
  DracoHeader header = read_draco_header(stream.substr(0, bytes), stream.size(), kPath);
  EXPECT_GT(header.begin_bytes_needed, 256U);
  EXPECT_EQ(header.counts.faces, 0U);
  while (header.begin_bytes_needed != 0) {
    ASSERT_GT(header.begin_bytes_needed, bytes);
    ASSERT_LE(header.begin_bytes_needed, stream.size());
    bytes = header.begin_bytes_needed;
    header = read_draco_header(stream.substr(0, bytes), stream.size(), kPath);
  }
  EXPECT_EQ(header.counts.faces, 8U);
  EXPECT_EQ(decode(stream).faces(), 8U);
}

/// An edgebreaker stream of version 2.2 with varint counts.
std::string hostile_header(std::uint64_t vertices, std::uint64_t faces, std::uint64_t symbols) {
  std::string stream("DRACO\2\2\1\1\0\0\0", 12);
  for (std::uint64_t value : {vertices, faces, std::uint64_t{1}, symbols, std::uint64_t{0}}) {
    for (; value >= 0x80; value >>= 7) stream += static_cast<char>(value | 0x80);
    stream += static_cast<char>(value);
  }
  return stream;
}

TEST(DracoHeader, RefusesCountsThatTheStreamCannotHold) {
  const auto read = [](const std::string& stream) {
    read_draco_header(stream, stream.size(), kPath);
  };
  EXPECT_NE(error_of([&] { read(hostile_header(10, 1000000, 1000000)); }).find("cannot hold"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read(hostile_header(4000000, 10, 10)); }).find("cannot hold"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read(hostile_header(10, 10, 11)); }).find("cannot hold"),
            std::string::npos);
  const std::string huge = hostile_header(10, 1073741824, 10) + std::string(1 << 17, '\0');
  EXPECT_NE(error_of([&] { read(huge); }, ErrorKind::kResource).find("1073741823"),
            std::string::npos);
}

TEST(DracoHeader, RefusesWhatIsNoStreamOfAKnownVersion) {
  const auto error = [](const std::string& stream) {
    return error_of([&] { read_draco_header(stream, stream.size(), kPath); });
  };
  EXPECT_NE(error("DRACK\2\2\1\1\0\0").find("must begin with"), std::string::npos);
  EXPECT_NE(error(std::string("DRACO\3\0\1\1\0\0", 11)).find("version 3.0"), std::string::npos);
  EXPECT_NE(error(std::string("DRACO\2\3\1\1\0\0", 11)).find("version 2.3"), std::string::npos);
  EXPECT_NE(error(std::string("DRACO\0\5\1\1\0\0", 11)).find("version 0.5"), std::string::npos);
  EXPECT_NE(error(std::string("DRACO\2\2\5\1\0\0", 11)).find("type 5"), std::string::npos);
  EXPECT_NE(error("").find("within its header"), std::string::npos);
  EXPECT_NE(error("DRA").find("within its header"), std::string::npos);
}

TEST(DracoMesh, KeepsFacesPositionsAndTexCoords) {
  const std::unique_ptr<draco::Mesh> grid = DracoGrid{.cells = 1}.mesh();
  const DracoMesh mesh = decode(encode_draco(*grid, {false, 5, 0, 0}));
  ASSERT_EQ(mesh.faces(), 2U);
  ASSERT_EQ(mesh.positions(), 4U);
  ASSERT_EQ(mesh.texcoords(), 4U);
  const std::array<std::array<float, 2>, 6> expected = {
      {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}};
  for (std::size_t i = 0; i < 6; ++i) {
    const FaceRecord face = mesh.face(i / 3);
    const TexCoord t = mesh.texcoord(raw(face.t[i % 3]));
    EXPECT_EQ(t.u, expected[i][0]);
    EXPECT_EQ(t.v, expected[i][1]);
    const Position p = mesh.position(raw(face.v[i % 3]));
    EXPECT_NEAR(p.x, t.u, 0.3);
    EXPECT_NEAR(p.y, t.v, 0.4);
    EXPECT_EQ(face.material, kNone<MaterialId>);
  }
  EXPECT_FALSE(mesh.quantization());
}

/// Decodes by Draco's own front, and compares value for value.
void expect_as_draco_decodes(const std::string& stream) {
  draco::DecoderBuffer buffer;
  buffer.Init(stream.data(), stream.size());
  draco::Decoder decoder;
  const auto expected = std::move(decoder.DecodeMeshFromBuffer(&buffer)).value();
  const DracoMesh mesh = decode(stream);
  ASSERT_EQ(mesh.faces(), expected->num_faces());
  const auto* positions = expected->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  const auto* texcoords = expected->GetNamedAttribute(draco::GeometryAttribute::TEX_COORD);
  for (std::uint32_t i = 0; i < mesh.faces(); ++i) {
    const FaceRecord face = mesh.face(i);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const draco::PointIndex point = expected->face(draco::FaceIndex(i))[corner];
      std::array<float, 3> p{};
      positions->GetMappedValue(point, p.data());
      const Position got = mesh.position(raw(face.v[corner]));
      ASSERT_EQ(std::bit_cast<std::uint64_t>(got.x), std::bit_cast<std::uint64_t>(double{p[0]}));
      ASSERT_EQ(std::bit_cast<std::uint64_t>(got.y), std::bit_cast<std::uint64_t>(double{p[1]}));
      ASSERT_EQ(std::bit_cast<std::uint64_t>(got.z), std::bit_cast<std::uint64_t>(double{p[2]}));
      std::array<float, 2> t{};
      texcoords->GetMappedValue(point, t.data());
      const TexCoord uv = mesh.texcoord(raw(face.t[corner]));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(uv.u), std::bit_cast<std::uint32_t>(t[0]));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(uv.v), std::bit_cast<std::uint32_t>(t[1]));
    }
  }
}

TEST(DracoMesh, HasBitForBitTheValuesThatDracoDequantizes) {
  for (const DracoEncoding& encoding : kEncodings) {
    for (const bool lie_apart : {false, true}) {
      const DracoGrid grid{.cells = 20, .lie_apart = lie_apart};
      expect_as_draco_decodes(encode_draco(*grid.mesh(), encoding));
    }
  }
}

TEST(DracoMesh, KnowsBitsAndStepsOfItsQuantization) {
  for (const bool edgebreaker : {false, true}) {
    const DracoGrid grid{.cells = 20};
    const DracoMesh mesh = decode(encode_draco(*grid.mesh(), {edgebreaker, 5, 16, 10}));
    ASSERT_TRUE(mesh.quantization());
    const Quantization quantization = *mesh.quantization();
    EXPECT_EQ(quantization.position_bits, 16U);
    EXPECT_EQ(quantization.uv_bits, 10U);
    EXPECT_NEAR(quantization.position_step, 20.0 / 65535, 1.0 / 65535);
    EXPECT_DOUBLE_EQ(quantization.uv_step, 1.0 / 1023);
    const DracoMesh half = decode(encode_draco(*grid.mesh(), {edgebreaker, 5, 0, 10}));
    EXPECT_EQ(half.quantization()->position_bits, 0U);
    EXPECT_EQ(half.quantization()->position_step, 0.0);
  }
}

TEST(DracoMesh, NamesTheMaterialsOfFaces) {
  for (const bool edgebreaker : {false, true}) {
    const std::string stream =
        encode_draco(*DracoGrid{.has_materials = true}.mesh(), {edgebreaker, 5, 0, 0});
    const std::vector<std::string> names = {"wall", "roof tiles"};
    const DracoHeader header = read_draco_header(stream, stream.size(), kPath);
    EXPECT_EQ(read_draco_material_names(stream, header), names);
    const DracoMesh mesh = decode(stream);
    EXPECT_EQ(mesh.material_names(), names);
    int roofs = 0;
    for (std::uint64_t i = 0; i < mesh.faces(); ++i) roofs += raw(mesh.face(i).material) == 1;
    EXPECT_EQ(roofs, 4);
  }
}

/// A triangle with positions of a type, and a second attribute of texture coordinates.
template <class T>
std::string typed_triangle(draco::DataType type, const std::array<std::array<T, 3>, 3>& values) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, type);
  builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  const draco::FaceIndex face(0);
  builder.SetAttributeValuesForFace(0, face, values[0].data(), values[1].data(), values[2].data());
  const std::array<float, 6> first = {-0.0F, 0, 1, 0, std::nanf(""), 1};
  const std::array<float, 6> second = {5, 5, 6, 5, 6, 6};
  builder.SetAttributeValuesForFace(1, face, &first[0], &first[2], &first[4]);
  builder.SetAttributeValuesForFace(2, face, &second[0], &second[2], &second[4]);
  return encode_draco(*builder.Finalize(), {false, 5, 0, 0});
}

TEST(DracoMesh, TakesPositionsOfAnyType) {
  const std::string doubles =
      typed_triangle<double>(draco::DT_FLOAT64, {{{0.1, 0, 0}, {1e300, 0, 0}, {0, 1, -1}}});
  EXPECT_EQ(decode(doubles).position(0).x, 0.1);
  EXPECT_EQ(decode(doubles).position(1).x, 1e300);
  const std::string integers =
      typed_triangle<std::int32_t>(draco::DT_INT32, {{{-5, 0, 0}, {7, 0, 0}, {0, 1, -1}}});
  EXPECT_EQ(decode(integers).position(0).x, -5);
  EXPECT_EQ(decode(integers).position(1).x, 7);
}

TEST(DracoMesh, TakesAttributesByTheirIdsOrTheFirstOfAKind) {
  const std::string stream =
      typed_triangle<float>(draco::DT_FLOAT32, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  const DracoMesh first = decode(stream);
  EXPECT_EQ(first.texcoord(0).u, 0.0F);
  EXPECT_FALSE(std::signbit(first.texcoord(0).u)) << "-0 is +0";
  EXPECT_TRUE(std::isnan(first.texcoord(2).u));
  EXPECT_EQ(decode(stream, {.position_id = 0, .texcoord_id = 2}).texcoord(0).u, 5.0F);
  const DracoMesh without = decode(stream, {.position_id = 0, .by_kind = false});
  EXPECT_EQ(without.texcoords(), 0U);
  EXPECT_EQ(without.face(0).t[0], kNone<TexCoordId>);
  EXPECT_NE(error_of([&] { decode(stream, {.by_kind = false}); }).find("without positions"),
            std::string::npos);
  EXPECT_NE(error_of([&] { decode(stream, {.position_id = 1}); }).find("of 2 components"),
            std::string::npos);
  EXPECT_NE(error_of([&] { decode(stream, {.texcoord_id = 9}); }).find("no attribute 9"),
            std::string::npos);
}

TEST(DracoMesh, RefusesEveryTruncationOfAStream) {
  for (const DracoEncoding& encoding : kEncodings) {
    const std::string stream = encode_draco(*DracoGrid{.has_materials = true}.mesh(), encoding);
    for (std::size_t bytes = 0; bytes < stream.size(); ++bytes) {
      const std::string error = error_of([&] { decode(stream.substr(0, bytes)); });
      EXPECT_TRUE(error.starts_with("model.drc: found")) << bytes << " of " << stream.size();
    }
  }
}

TEST(DracoMesh, TakesNoMoreMemoryForAnyHugeNumberInAStream) {
  int claims = 0;
  for (const DracoEncoding& encoding : {DracoEncoding{true, 0, 11, 10}, {false, 0, 11, 10}}) {
    const std::string stream = encode_draco(*DracoGrid{.lie_apart = true}.mesh(), encoding);
    for (std::size_t i = 0; i + 4 <= stream.size(); ++i) {
      std::string damaged = stream;
      damaged.replace(i, 4, "\xff\xff\xff\x7f");
      try {
        decode(damaged);
      } catch (const Error& error) {
        claims += std::string(error.what()).find("takes more than") != std::string::npos;
      }
    }
  }
  EXPECT_GT(claims, 0) << "the number of orientations is one";
}

TEST(DracoMesh, RefusesAttributesThatTheHeaderHasNoRoomFor) {
  const DracoGrid grid{.cells = 100, .further_attributes = 6};
  const std::string stream = encode_draco(*grid.mesh(), {false, 5, 0, 0});
  EXPECT_NE(error_of([&] { decode(stream); }, ErrorKind::kResource).find("found 8 attributes"),
            std::string::npos);
  const DracoGrid small{.cells = 10, .further_attributes = 6};
  EXPECT_NO_THROW(decode(encode_draco(*small.mesh(), {false, 5, 0, 0})));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
std::uint64_t status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key)) return std::stoull(line.substr(key.size() + 1)) << 10;
  }
  return 0;
}

/// Whether decoding stays below the bound, in a process of its own.
bool stays_below(const std::string& stream, std::uint64_t bound) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;
    const std::uint64_t before = status_bytes("VmRSS:");
    const DracoMesh mesh = decode(stream);
    ::_exit(status_bytes("VmHWM:") - before <= bound ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(DracoMesh, TakesNoMoreToDecodeThanTheHeaderSays) {
  for (const DracoEncoding& encoding : kEncodings) {
    for (const bool lie_apart : {false, true}) {
      for (const bool is_soup : {false, true}) {
        const DracoGrid grid{.cells = 200, .lie_apart = lie_apart, .is_soup = is_soup};
        const std::string stream = encode_draco(*grid.mesh(), encoding);
        const DracoHeader header = read_draco_header(stream, stream.size(), kPath);
        EXPECT_TRUE(stays_below(stream, header.decoding_bytes))
            << encoding.edgebreaker << encoding.speed << lie_apart << is_soup;
        EXPECT_FALSE(stays_below(stream, header.decoding_bytes / 8)) << "the test can see it";
      }
    }
  }
}
#endif

// The streams beside the checkout.

struct SharedCase {
  const char* name;
  std::uint64_t positions, texcoords, faces;
  std::uint32_t position_bits, uv_bits;
};

constexpr SharedCase kShared[] = {
    {"bunny_gltf.drc", 34834, 0, 69451, 14, 0},
    {"car.drc", 1856, 1856, 1744, 0, 0},
    {"cube_att.drc", 8, 24, 12, 14, 12},
    {"cube_att.obj.edgebreaker.cl10.2.2.drc", 8, 24, 12, 20, 12},
    {"cube_att.obj.edgebreaker.cl4.2.2.drc", 24, 24, 12, 20, 12},
    {"cube_att.obj.sequential.cl3.2.2.drc", 24, 24, 12, 20, 12},
    {"cube_att_sub_o_2.drc", 8, 24, 12, 14, 12},
    {"cube_att_sub_o_no_metadata.drc", 8, 24, 12, 14, 12},
    {"octagon_preserved.drc", 8, 0, 6, 11, 0},
    {"test_nm.obj.edgebreaker.0.10.0.drc", 99, 0, 170, 0, 0},
    {"test_nm.obj.edgebreaker.0.9.1.drc", 99, 0, 170, 0, 0},
    {"test_nm.obj.edgebreaker.1.0.0.drc", 99, 0, 170, 0, 0},
    {"test_nm.obj.edgebreaker.1.1.0.drc", 99, 0, 170, 20, 0},
    {"test_nm.obj.edgebreaker.cl10.2.2.drc", 99, 0, 170, 20, 0},
    {"test_nm.obj.edgebreaker.cl4.2.2.drc", 99, 0, 170, 20, 0},
    {"test_nm.obj.sequential.0.10.0.drc", 97, 0, 170, 0, 0},
    {"test_nm.obj.sequential.0.9.1.drc", 97, 0, 170, 0, 0},
    {"test_nm.obj.sequential.1.0.0.drc", 97, 0, 170, 0, 0},
    {"test_nm.obj.sequential.1.1.0.drc", 97, 0, 170, 20, 0},
    {"test_nm.obj.sequential.cl3.2.2.drc", 97, 0, 170, 20, 0},
    {"test_nm_quant.0.9.0.drc", 99, 0, 170, 14, 0},
};

class SharedDraco : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) {
      GTEST_SKIP() << "NOTE: no models beside this checkout, nothing is decoded";
    }
  }
  std::string stream_of(const std::string& name) const { return content_of(folder_ / name); }

  std::filesystem::path folder_ = shared_folder() / "data/draco";
};

TEST_F(SharedDraco, IsDecodedInEveryVersion) {
  for (const SharedCase& expected : kShared) {
    SCOPED_TRACE(expected.name);
    const std::string stream = stream_of(expected.name);
    const DracoHeader header = read_draco_header(stream.substr(0, 256), stream.size(), kPath);
    EXPECT_EQ(header.counts.positions, expected.positions);
    EXPECT_EQ(header.counts.faces, expected.faces);
    const DracoMesh mesh = decode(stream);
    EXPECT_EQ(mesh.positions(), expected.positions);
    EXPECT_EQ(mesh.texcoords(), expected.texcoords);
    EXPECT_EQ(mesh.faces(), expected.faces);
    const Quantization quantization = mesh.quantization().value_or(Quantization{});
    EXPECT_EQ(quantization.position_bits, expected.position_bits);
    EXPECT_EQ(quantization.uv_bits, expected.uv_bits);
  }
}

TEST_F(SharedDraco, IsRefusedWhereItIsAPointCloud) {
  for (const char* const name :
       {"cube_pc.drc", "pc_color.drc", "pc_kd_color.drc", "point_cloud_no_qp.drc"}) {
    const std::string stream = stream_of(name);
    EXPECT_FALSE(read_draco_header(stream, stream.size(), kPath).is_mesh);
    EXPECT_NE(error_of([&] { decode(stream); }).find("point cloud of "), std::string::npos);
  }
}

/// One kind of mesh in streams of five versions: the same area in all.
double area_of(const DracoMesh& mesh) {
  double area = 0;
  for (std::uint64_t i = 0; i < mesh.faces(); ++i) {
    const FaceRecord face = mesh.face(i);
    const Position a = mesh.position(raw(face.v[0]));
    const Position b = mesh.position(raw(face.v[1]));
    const Position c = mesh.position(raw(face.v[2]));
    const Position e{b.x - a.x, b.y - a.y, b.z - a.z};
    const Position f{c.x - a.x, c.y - a.y, c.z - a.z};
    area += std::hypot(e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x) / 2;
  }
  return area;
}

TEST_F(SharedDraco, HasTheSameSurfaceInEveryVersion) {
  const double area = area_of(decode(stream_of("test_nm.obj.sequential.1.0.0.drc")));
  for (const SharedCase& other : kShared) {
    if (!std::string(other.name).starts_with("test_nm")) continue;
    EXPECT_NEAR(area_of(decode(stream_of(other.name))), area, 1e-3 * area) << other.name;
  }
}

}  // namespace
}  // namespace atlasgauge
