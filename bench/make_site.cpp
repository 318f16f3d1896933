// Makes a site of any size with the answers that a report on it must give, or checks a report.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "bench/site.hpp"
#include "bench/tool.hpp"
#include "io/error.hpp"

namespace {

using namespace atlasgauge;

struct Arguments {
  SiteOptions site;
  std::string directory = ".";
  std::vector<std::string> check;  ///< report and answers
};

void describe(CLI::App& app, Arguments& arguments) {
  SiteOptions& site = arguments.site;
  const std::map<std::string, ImageFormat> formats{
      {"png", ImageFormat::kPng}, {"jpg", ImageFormat::kJpg}, {"none", ImageFormat::kNone}};
  app.add_option("--faces", site.faces, "About so many faces")->capture_default_str();
  app.add_option("--textures", site.textures, "Textures")->capture_default_str();
  app.add_option("--texture-size", site.texture_size_texels, "Side of a texture, a power of two")
      ->capture_default_str();
  app.add_option("--texture-format", site.image_format,
                 "png, jpg, or none: then measure with -t SIZExSIZE")
      ->transform(CLI::CheckedTransformer(formats));
  app.add_option("--chart-min", site.chart_side_min_quads, "Shortest side of a chart, in quads")
      ->capture_default_str();
  app.add_option("--chart-max", site.chart_side_max_quads, "Longest side of a chart, in quads")
      ->capture_default_str();
  app.add_option("--shuffle-faces", site.shuffle_seed, "Faces in random order, from this seed");
  app.add_option("--shuffle-vertices", site.vertex_shuffle_seed,
                 "Vertices in random order, from this seed");
  app.add_flag("--duplicate-vertices", site.duplicate_vertices,
               "Every chart has vertices of its own");
  app.add_option("--decimals", site.decimals, "Decimals of positions, 6 to 15")
      ->capture_default_str();
  app.add_option("--out", arguments.directory, "Directory to write to")->capture_default_str();
  app.add_option("--name", site.name, "File name without ending")->capture_default_str();
  app.add_option("--check", arguments.check, "REPORT ANSWERS: compare instead of making")
      ->expected(2);
}

int check(const std::string& report, const std::string& answers) {
  const std::vector<std::string> lines = differences_of_files(report, answers);
  for (const std::string& line : lines) fmt::print("{}\n", line);
  return lines.empty() ? 0 : 1;
}

int make(const Arguments& arguments) {
  const Site site(arguments.site);
  std::error_code fault;
  std::filesystem::create_directories(arguments.directory, fault);
  if (fault) throw Error(ErrorKind::kResource, arguments.directory, 0, fault.message());
  write_site(site, arguments.directory);
  fmt::print("{}/{}.obj: {} faces, {} vertices, {} texture coordinates, {} charts, {} textures\n",
             arguments.directory, site.options().name, site.faces(), site.vertices(),
             site.texcoords(), site.charts(), site.options().textures);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Makes a textured site scan with known answers, or checks a report against them."};
  Arguments arguments;
  describe(app, arguments);
  return atlasgauge::run_tool("make_site", app, argc, argv, [&] {
    if (!arguments.check.empty()) return check(arguments.check[0], arguments.check[1]);
    return make(arguments);
  });
}
