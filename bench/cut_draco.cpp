// Cuts an OBJ into Draco streams, and writes what they decode to as an OBJ.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

#include "bench/draco_cut.hpp"
#include "bench/tool.hpp"

int main(int argc, char** argv) {
  using namespace atlasgauge;
  CLI::App app{"Cuts an OBJ into Draco streams, and writes what they decode to as an OBJ."};
  DracoCutOptions options;
  std::string model, directory = ".";
  app.add_option("MODEL", model, "An OBJ, as make_site makes them")->required();
  app.add_option("--out", directory, "Directory to write to, not that of the model")->required();
  app.add_option("--chunk-faces", options.chunk_faces, "Faces of a stream, at most")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--position-bits", options.position_bits)->capture_default_str();
  app.add_option("--uv-bits", options.uv_bits)->capture_default_str();
  app.add_flag("--own-grids", options.own_grids, "Each stream rounds positions on its own grid");
  app.add_flag("--sequential", options.sequential, "Sequential encoding instead of Edgebreaker");
  return atlasgauge::run_tool("cut_draco", app, argc, argv, [&] {
    fmt::print("{} streams\n", cut_into_draco(model, options, directory));
    return 0;
  });
}
