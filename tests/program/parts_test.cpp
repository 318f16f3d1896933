// Models that come in parts, against what they hold written as one OBJ.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench/draco_cut.hpp"
#include "bench/site.hpp"
#include "io/error.hpp"
#include "io/image/image_module.hpp"
#include "io/image/image_reader.hpp"
#include "io/open_parts.hpp"
#include "io/texture/mtl_reader.hpp"
#include "tests/support/module_folder.hpp"
#include "tests/support/pipeline_run.hpp"
#include "tests/support/reference_reports.hpp"
#include "tests/support/shared_folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<PartReader> open_any(const std::string& path, Warnings& warnings) {
  return open_parts(path, {}, warnings);
}

std::vector<std::string> streams_in(const fs::path& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".drc") paths.push_back(entry.path().string());
  }
  std::ranges::sort(paths);
  return paths;
}

/// What does not depend on how the model is packed.
Json without_packing(Json report) {
  for (const char* key : {"mesh", "textures", "quantization", "cracks", "cracks_len"}) {
    report.erase(key);
  }
  return report;
}

/// A site with images, cut into Draco streams of a few thousand faces.
class DracoSiteTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    show_modules(kImageModuleFile);
    dir_ = new TempDir;
    SiteOptions options;
    options.faces = 20'000;
    options.textures = 3;
    options.texture_size_texels = 256;
    write_site(Site(options), folder("site"));
    cut_into_draco(folder("site") + "/site.obj", {.chunk_faces = 3000}, folder("common"));
    cut_into_draco(folder("site") + "/site.obj", {.chunk_faces = 3000, .own_grids = true},
                   folder("own"));
    cut_into_draco(folder("site") + "/site.obj", {.chunk_faces = 3000, .sequential = true},
                   folder("sequential"));
  }
  static void TearDownTestSuite() { delete dir_; }

  static std::string folder(const std::string& name) {
    const fs::path path = dir_->path() / name;
    fs::create_directories(path);
    return path.string();
  }

  static Json measure(const std::vector<std::string>& inputs, PipelineConfig config = {}) {
    config.probe = read_image_header;
    config.open_image = open_image;
    config.open_parts = open_any;
    return run_pipeline(inputs, config).report;
  }
  static Json measure_streams(const std::string& name, const PipelineConfig& config = {}) {
    return measure(streams_in(dir_->path() / name), config);
  }
  static Json measure_decoded(const std::string& name) {
    return measure({folder(name) + "/site.obj"});
  }

  static TempDir* dir_;
};

TempDir* DracoSiteTest::dir_ = nullptr;

TEST_F(DracoSiteTest, StreamsMeasureAsWhatTheyDecodeTo) {
  for (const char* name : {"common", "own", "sequential"}) {
    SCOPED_TRACE(name);
    ASSERT_GT(streams_in(dir_->path() / name).size(), 6U);
    EXPECT_EQ(without_packing(measure_streams(name)).dump(1),
              without_packing(measure_decoded(name)).dump(1));
  }
}

TEST_F(DracoSiteTest, MemoryAndThreadsChangeNothing) {
  const std::string report = measure_streams("own").dump();
  for (const std::size_t workers : {1U, 3U}) {
    PipelineConfig config;
    config.engine_bytes = 16 << 20;
    config.workers = workers;
    EXPECT_EQ(measure_streams("own", config).dump(), report) << workers;
  }
}

TEST_F(DracoSiteTest, GridsOfTheirOwnOpenCracksAndACommonOneDoesNot) {
  const Json common = measure_streams("common");
  EXPECT_EQ(common["cracks"], 0);
  EXPECT_EQ(common["cracks_len"], 0);
  const Json own = measure_streams("own");
  EXPECT_GT(own["cracks"], 100);
  EXPECT_GT(own["cracks_len"], 1);
  EXPECT_LT(own["vndup"], common["vndup"]) << "what comes apart does not weld";
}

TEST_F(DracoSiteTest, QuantizationIsToldOfEveryStream) {
  const Json report = measure_streams("common");
  ASSERT_EQ(report["quantization"].size(), streams_in(dir_->path() / "common").size());
  const Json& first = report["quantization"][0];
  EXPECT_EQ(first["input"], "site_00000.drc");
  EXPECT_EQ(first["position_bits"], 16);
  EXPECT_EQ(first["uv_bits"], 14);
  EXPECT_GT(first["position_step"], 0);
  EXPECT_LT(first["uv_step_texels"].get<double>(), 256.0 / (1 << 14));
}

TEST_F(DracoSiteTest, StreamsThatShareAnImageShareItsSlot) {
  const Json report = measure_streams("common");
  EXPECT_EQ(report["ntex"], 3);
  EXPECT_EQ(report["textures"][0], "site_00000.png");
}

TEST_F(DracoSiteTest, ObjFilesAndStreamsMakeOneModel) {
  const std::string whole = folder("common") + "/site.obj";
  std::vector<std::string> mixed = streams_in(dir_->path() / "common");
  mixed.push_back(whole);
  const Json report = measure(mixed);
  const Json one = measure_decoded("common");
  EXPECT_EQ(report["fn"], 2 * one["fn"].get<std::uint64_t>());
  EXPECT_EQ(report["ntex"], 3);
  EXPECT_EQ(report["connected_components"], 2 * one["connected_components"].get<std::uint64_t>());
  EXPECT_EQ(report["area"], 2 * one["area"].get<double>());
}

/// Writes parts as an OBJ whose numbers have so many digits, with materials of a library in order.
class ObjOfParts : public MeshSink {
 public:
  struct Digits {
    int position, texcoord;
  };

  ObjOfParts(const fs::path& path, const fs::path& library, Digits digits)
      : obj_(path), digits_(digits) {
    Warnings warnings({});
    for (const Material& material : read_mtl(library.string(), warnings)) {
      materials_.push_back(material.name);
    }
    obj_ << "mtllib " << library.string() << "\n";
  }

  void add_part(MeshPart& part) {
    Warnings warnings({});
    part.load();
    part.emit(*this, warnings);
    positions_before_ = positions_;
    texcoords_before_ = texcoords_;
  }

  void add(const MeshBatch& batch) override {
    for (const Position& p : batch.positions) {
      obj_ << fmt::format("v {0:.{3}g} {1:.{3}g} {2:.{3}g}\n", p.x, p.y, p.z, digits_.position);
    }
    for (const TexCoord& t : batch.texcoords) {
      obj_ << fmt::format("vt {0:.{2}g} {1:.{2}g}\n", t.u, t.v, digits_.texcoord);
    }
    positions_ += batch.positions.size();
    texcoords_ += batch.texcoords.size();
    for (const FaceRecord& face : batch.faces) {
      obj_ << "usemtl " << materials_.at(raw(face.material)) << "\nf";
      for (int k = 0; k < 3; ++k) {
        obj_ << fmt::format(" {}/{}", positions_before_ + raw(face.v[k]) + 1,
                            texcoords_before_ + raw(face.t[k]) + 1);
      }
      obj_ << "\n";
    }
  }

 private:
  std::ofstream obj_;
  Digits digits_;
  std::vector<std::string> materials_;
  std::uint64_t positions_ = 0, texcoords_ = 0, positions_before_ = 0, texcoords_before_ = 0;
};

/// A tileset, and an OBJ that others made of its leaves with seven digits a number, and images.
class TileTwinTest : public testing::Test {
 protected:
  void SetUp() override {
    show_modules(kImageModuleFile);
    const std::vector<ReferenceReport> references = reference_reports();
    const auto found = std::ranges::find(references, "derived/nasa_tiles_leaves/nasa_leaves.obj",
                                         &ReferenceReport::name);
    if (found == references.end()) {
      GTEST_SKIP() << "SKIPPED: no reference reports beside this checkout";
    }
    twin_ = found->model;
    tileset_ = twin_.parent_path() / "../../nasa_3dtilesrenderer/data/tileset.json";
    config_.probe = read_image_header;
    config_.open_image = open_image;
    config_.open_parts = open_any;
  }

  Json measure_tileset() const { return run_pipeline(tileset_.string(), config_).report; }
  Json measure_twin() const { return run_pipeline(twin_.string(), config_).report; }
  /// The tileset's leaves, written as an OBJ that uses the images of the twin.
  Json measure_written(ObjOfParts::Digits digits) const {
    const TempDir dir;
    const fs::path path = dir.path() / twin_.filename();
    Warnings warnings({});
    {
      ObjOfParts obj(path, twin_.parent_path() / "nasa_leaves.mtl", digits);
      const auto tiles = open_parts(tileset_.string(), {}, warnings);
      while (const std::unique_ptr<MeshPart> part = tiles->next()) obj.add_part(*part);
    }
    return run_pipeline(path.string(), config_).report;
  }

  fs::path twin_, tileset_;
  PipelineConfig config_;
};

TEST_F(TileTwinTest, RoundedAsItsTwinTheTilesetGivesTheReportOfTheTwin) {
  EXPECT_EQ(measure_written({7, 7}).dump(1), measure_twin().dump(1));
}

TEST_F(TileTwinTest, WrittenExactlyTheTilesetGivesTheReportOfTheTileset) {
  EXPECT_EQ(without_packing(measure_written({17, 9})).dump(1),
            without_packing(measure_tileset()).dump(1));
}

TEST_F(TileTwinTest, WhatRoundingCannotChangeIsEqualAsItIs) {
  const Json tileset = measure_tileset(), twin = measure_twin();
  for (const char* key :
       {"fn", "vn", "en", "en_b", "nonmanif_edge", "nonmanif_vert", "connected_components",
        "boundary_loops", "euler", "fndup", "fndegen", "vnunref", "oriented", "orientable", "ntex",
        "faces_unmapped", "faces_untextured", "faces_invalid", "largest_component_fn"}) {
    EXPECT_EQ(tileset[key], twin[key]) << key;
  }
}

/// A real model that is no OBJ, and its faces; 0 where it is a point cloud.
struct RealInput {
  const char* path;
  int faces;
};

TEST(RealInputsTest, EveryOneIsMeasuredOrRefusedForBeingAPointCloud) {
  const fs::path data = shared_folder() / "data";
  if (!fs::exists(data)) GTEST_SKIP() << "SKIPPED: no real models beside this checkout";
  show_modules(kImageModuleFile);
  PipelineConfig config;
  config.probe = read_image_header;
  config.open_image = open_image;
  config.open_parts = open_any;
  const std::vector<RealInput> inputs = {
      {"draco/bunny_gltf.drc", 69451},
      {"draco/car.drc", 1744},
      {"draco/cube_att.drc", 12},
      {"draco/cube_att.obj.edgebreaker.cl10.2.2.drc", 12},
      {"draco/cube_att.obj.edgebreaker.cl4.2.2.drc", 12},
      {"draco/cube_att.obj.sequential.cl3.2.2.drc", 12},
      {"draco/cube_att.ply", 12},
      {"draco/cube_att_sub_o_2.drc", 12},
      {"draco/cube_att_sub_o_no_metadata.drc", 12},
      {"draco/cube_pc.drc", 0},
      {"draco/octagon_preserved.drc", 6},
      {"draco/pc_color.drc", 0},
      {"draco/pc_kd_color.drc", 0},
      {"draco/point_cloud_no_qp.drc", 0},
      {"draco/test_nm.obj.edgebreaker.0.10.0.drc", 170},
      {"draco/test_nm.obj.edgebreaker.0.9.1.drc", 170},
      {"draco/test_nm.obj.edgebreaker.1.0.0.drc", 170},
      {"draco/test_nm.obj.edgebreaker.1.1.0.drc", 170},
      {"draco/test_nm.obj.edgebreaker.cl10.2.2.drc", 170},
      {"draco/test_nm.obj.edgebreaker.cl4.2.2.drc", 170},
      {"draco/test_nm.obj.sequential.0.10.0.drc", 170},
      {"draco/test_nm.obj.sequential.0.9.1.drc", 170},
      {"draco/test_nm.obj.sequential.1.0.0.drc", 170},
      {"draco/test_nm.obj.sequential.1.1.0.drc", 170},
      {"draco/test_nm.obj.sequential.cl3.2.2.drc", 170},
      {"draco/test_nm_quant.0.9.0.drc", 170},
      {"draco/Box/glTF/Box.gltf", 12},
      {"draco/Box/glTF_Binary/Box.glb", 12},
      {"draco/Box/glTF_Binary/Box_Draco.glb", 12},
      {"draco/BoxMetaDraco/glTF/BoxMetaDraco.gltf", 12},
      {"loadersgl/3d-tiles/test/data/143.b3dm", 28222},
      {"loadersgl/gltf/test/data/3d-tiles/tile.glb", 9439},
      {"loadersgl/tile-converter/test/data/Frankfurt/L5/OF/474_5548_-1_lv5_group_0.osgb_3.b3dm",
       49427},
      {"nasa_3dtilesrenderer/data/tileset-add.json", 298357},
      {"nasa_3dtilesrenderer/data/tileset-broken-root-content.json", 177950},
      {"nasa_3dtilesrenderer/data/tileset-external-broken.json", 166946},
      {"nasa_3dtilesrenderer/data/tileset-external.json", 177950},
      {"nasa_3dtilesrenderer/data/tileset-no-root-content.json", 177950},
      {"trimesh/BoxTextured.ply", 12},
      {"trimesh/cube_blender_uv.ply", 12},
      {"trimesh/fuze.ply", 1000},
      {"trimesh/fuze_ascii.ply", 1000},
  };
  for (const RealInput& input : inputs) {
    SCOPED_TRACE(input.path);
    try {
      EXPECT_EQ(run_pipeline((data / input.path).string(), config).report["fn"], input.faces);
    } catch (const Error& error) {
      EXPECT_EQ(input.faces, 0) << error.what();
      EXPECT_NE(std::string(error.what()).find("point cloud"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace atlasgauge
