// Makes a scene of seam edges between random places of many textures, with the answers that a
// report on it must give.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <thread>

#include "bench/seam_scene.hpp"
#include "bench/tool.hpp"
#include "io/error.hpp"

namespace {

using namespace atlasgauge;

struct Arguments {
  SeamSceneOptions scene;
  std::string directory = ".";
  std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
};

void describe(CLI::App& app, Arguments& arguments) {
  SeamSceneOptions& scene = arguments.scene;
  const std::map<std::string, SceneContent> contents{{"photo", SceneContent::kPhoto},
                                                     {"constant", SceneContent::kConstant}};
  app.add_option("--edges", scene.edges, "Seam edges")->capture_default_str();
  app.add_option("--textures", scene.textures, "Textures")->capture_default_str();
  app.add_option("--texture-size", scene.texture_size_texels, "Side of a texture, in texels")
      ->capture_default_str();
  app.add_option("--length", scene.length_texels,
                 "Mean length of the sides of seams, in texels; they spread from half of it to "
                 "one and a half")
      ->capture_default_str();
  app.add_option("--format", scene.image_format, "jpg, png or tif")->capture_default_str();
  app.add_option("--content", scene.content,
                 "photo, or constant: one colour a texture, and all discrepancies are known")
      ->transform(CLI::CheckedTransformer(contents));
  app.add_option("--seed", scene.seed, "What all random numbers follow from")
      ->capture_default_str();
  app.add_option("--threads", arguments.threads, "Images made at a time")
      ->check(CLI::PositiveNumber);
  app.add_option("--out", arguments.directory, "Directory to write to")->capture_default_str();
  app.add_option("--name", scene.name, "File name without ending")->capture_default_str();
}

void make(const Arguments& arguments) {
  const SeamScene scene(arguments.scene);
  std::error_code fault;
  std::filesystem::create_directories(arguments.directory, fault);
  if (fault) throw Error(ErrorKind::kResource, arguments.directory, 0, fault.message());
  write_seam_scene(scene, arguments.directory, arguments.threads);
  fmt::print("{}/{}.obj: {} faces, {} seam edges, {} sample pairs, {} textures\n",
             arguments.directory, scene.options().name, scene.faces(), scene.options().edges,
             scene.sample_pairs(), scene.options().textures);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Makes a scene of seams with known answers, to be checked with make_site --check."};
  Arguments arguments;
  describe(app, arguments);
  return atlasgauge::run_tool("make_seams", app, argc, argv, [&] {
    make(arguments);
    return 0;
  });
}
