#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/corpus/corpus_command.hpp"
#include "io/progress_bar.hpp"
#include "io/texture/texture_slots.hpp"

namespace atlasgauge {

enum class RasterChoice { kScalar, kOsmesa };

/// What the user asked for.
struct Options {
  std::vector<std::string> models;         ///< inputs and glob patterns: one model
  std::optional<std::string> json_path;    ///< "-" is stdout
  std::optional<std::string> charts_path;  ///< of a known table format
  std::optional<std::string> maps_dir;
  std::optional<std::string> seams_path;  ///< of a known table format, or PLY
  bool texmetro_seams = false;
  std::optional<std::uint32_t> lod;  ///< of 3D Tiles: the depth of the tiles to show
  std::optional<ImageSize> texture_size;
  RasterChoice raster = RasterChoice::kScalar;
  std::optional<std::uint64_t> memory_bytes;
  std::optional<std::uint64_t> engine_memory_bytes;
  std::optional<std::uint64_t> block_bytes;
  std::optional<std::uint32_t> tile_texels;  ///< side of a tile
  std::size_t threads = 0;                   ///< 0: as many as the process may use
  std::string tmp_dir;
  ProgressMode progress = ProgressMode::kAuto;
  bool quiet = false;
  bool verbose = false;
  bool strict = false;
  bool estimate = false;  ///< say what a run would cost instead of measuring
};

/// What a command line comes to: options of `measure`, a command of `corpus`, or a text to print
/// instead of working (help, version).
struct CommandLine {
  Options options;
  std::optional<CorpusCommand> corpus;
  std::optional<std::string> text;
};

/// Arguments without the program's name, in any order; `measure` in front may be left out. Opens no
/// file. Throws Error(kUsage).
CommandLine parse_command_line(std::vector<std::string> arguments);

}  // namespace atlasgauge
