#include "io/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <utility>
#include <variant>

#include "io/bytes.hpp"
#include "io/corpus/corpus_command_line.hpp"
#include "io/error.hpp"
#include "io/parsed_number.hpp"
#include "io/program_identity.hpp"
#include "io/progress_option.hpp"
#include "io/suffix.hpp"
#include "io/table_file.hpp"

namespace atlasgauge {
namespace {

ImageSize parse_image_size(const std::string& text) {
  ImageSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool has_x = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = has_x ? std::from_chars(width.ptr + 1, end, size.height) : width;
  const bool whole = has_x && height.ec == std::errc() && height.ptr == end;
  if (!whole || size.width == 0 || size.height == 0) {
    throw Error(ErrorKind::kUsage,
                "-t '" + text + "' is not a texture size; give WIDTHxHEIGHT, as in 4096x4096");
  }
  return size;
}

std::uint32_t parse_tile_texels(const std::string& text) {
  constexpr std::uint32_t kLeast = 8, kMost = 4096;
  const auto texels = parsed_number<std::uint32_t>(text);
  if (!texels || !std::has_single_bit(*texels) || *texels < kLeast || *texels > kMost) {
    throw Error(ErrorKind::kUsage, "--tile-size '" + text +
                                       "' is not the side of a tile; give a power of two from 8 "
                                       "to 4096");
  }
  return *texels;
}

void check_seams_path(const std::string& path) {
  const bool known = has_suffix(path, ".csv") || has_suffix(path, ".jsonl") ||
                     has_suffix(path, ".ndjson") || has_suffix(path, ".ply");
  if (known) return;
  throw Error(ErrorKind::kUsage, path, 0,
              "seam edges are CSV, JSON Lines or PLY by the name; let it end in .csv, .jsonl or "
              ".ply");
}

std::string default_tmp_dir() {
  const char* from_environment = std::getenv("TMPDIR");
  return from_environment != nullptr && *from_environment != 0 ? from_environment : "/var/tmp";
}

/// Texts of the options as given, until they are checked.
struct Texts {
  std::string json, size, memory, engine_memory, block_bytes, tile_size;
  std::string progress = "auto", raster = "scalar";
};

void describe(CLI::App& app, Options& options, Texts& texts) {
  app.add_option("MODEL", options.models,
                 "the model: OBJ, PLY (both also .gz or .zst), Draco (.drc), glTF (.gltf, .glb), "
                 "3D Tiles (tileset.json, .b3dm); several files or patterns are one model")
      ->required();
  app.add_option("--lod", options.lod,
                 "of 3D Tiles: measure the tiles at depth N below the root, and the leaves above "
                 "(default: the leaves)")
      ->type_name("N");
  app.add_option("--json", texts.json, "write the report to FILE; - is standard output")
      ->type_name("FILE");
  app.add_option("--charts", options.charts_path,
                 "write a table of all charts to FILE: CSV (.csv) or JSON Lines (.jsonl)")
      ->type_name("FILE");
  app.add_option("--maps", options.maps_dir,
                 "write a map of each texture into DIR: OpenEXR with all mip levels, and a picture")
      ->type_name("DIR");
  app.add_option("--seams", options.seams_path,
                 "write all seam edges to FILE: CSV (.csv), JSON Lines (.jsonl), or coloured "
                 "segments (.ply)")
      ->type_name("FILE");
  app.add_flag("--texmetro-seams", options.texmetro_seams,
               "measure seams as TexMetro does, too, to compare with its published numbers");
  app.add_option("-t,--texture-size", texts.size,
                 "texture size for models that name no image, and for images that cannot be read")
      ->type_name("WxH");
  app.add_option("--memory", texts.memory,
                 "limit of the process's resident memory, at least 256M (default: 0.8 of what the "
                 "cgroup, Slurm or the machine allow)")
      ->type_name("BYTES");
  app.add_option("--threads", options.threads, "worker threads (default: the CPUs it may use)")
      ->type_name("N");
  app.add_option("--tmp-dir", options.tmp_dir, "directory for scratch (default: TMPDIR, /var/tmp)")
      ->type_name("DIR");
  app.add_option("--raster", texts.raster,
                 "what draws the triangles: its own raster, or OSMesa as a cross-check")
      ->check(CLI::IsMember({"scalar", "osmesa"}))
      ->type_name("scalar|osmesa");
  add_progress_option(app, texts.progress);
  app.add_flag("--estimate", options.estimate,
               "print what a run would need of memory, scratch and time, from a sample of the "
               "model, and do not run");
  app.add_flag("--strict", options.strict, "make every warning an error");
  app.add_flag("-q,--quiet", options.quiet, "print errors only");
  app.add_flag("-v,--verbose", options.verbose, "print what the run cost, stage by stage");
  app.add_option("--engine-memory", texts.engine_memory,
                 "for tests: working memory of the engine alone, however small")
      ->type_name("BYTES")
      ->group("Testing");
  app.add_option("--block-bytes", texts.block_bytes, "for tests: size of a scratch block")
      ->type_name("BYTES")
      ->group("Testing");
  app.add_option("--tile-size", texts.tile_size,
                 "for tests: side of a tile of a texture, in texels")
      ->type_name("N")
      ->group("Testing");
  app.set_version_flag("--version", "atlasgauge " + program_version());
}

std::optional<std::uint64_t> optional_bytes(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(parse_bytes(text));
}

void check(Options& options, const Texts& texts) {
  if (!texts.json.empty()) options.json_path = texts.json;
  if (options.charts_path) table_format(*options.charts_path);
  if (options.seams_path) check_seams_path(*options.seams_path);
  if (options.maps_dir == "") throw Error(ErrorKind::kUsage, "--maps '' is not a folder");
  if (!texts.size.empty()) options.texture_size = parse_image_size(texts.size);
  options.memory_bytes = optional_bytes(texts.memory);
  options.engine_memory_bytes = optional_bytes(texts.engine_memory);
  options.block_bytes = optional_bytes(texts.block_bytes);
  if (!texts.tile_size.empty()) options.tile_texels = parse_tile_texels(texts.tile_size);
  options.raster = texts.raster == "osmesa" ? RasterChoice::kOsmesa : RasterChoice::kScalar;
  options.progress = progress_mode(texts.progress);
  if (options.tmp_dir.empty()) options.tmp_dir = default_tmp_dir();
}

CommandLine corpus_line(std::vector<std::string> arguments) {
  CommandLine line;
  auto parsed = parse_corpus_command(std::move(arguments));
  if (auto* const text = std::get_if<std::string>(&parsed)) line.text = std::move(*text);
  if (auto* const command = std::get_if<CorpusCommand>(&parsed)) line.corpus = std::move(*command);
  return line;
}

}  // namespace

CommandLine parse_command_line(std::vector<std::string> arguments) {
  const std::string first = arguments.empty() ? "" : arguments.front();
  if (first == "measure" || first == "corpus") arguments.erase(arguments.begin());
  if (first == "corpus") return corpus_line(std::move(arguments));
  CommandLine line;
  Texts texts;
  CLI::App app(
      "Measures a textured mesh that need not fit in memory.\n"
      "Usage: atlasgauge [measure] MODEL... [OPTIONS]\n"
      "       atlasgauge corpus plan|run|status|gather ...");
  describe(app, line.options, texts);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them last first
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    line.text = app.help();
    return line;
  } catch (const CLI::CallForVersion&) {
    line.text = app.version() + "\n";
    return line;
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::kUsage, std::string(error.what()) + "; see atlasgauge --help");
  }
  check(line.options, texts);
  return line;
}

}  // namespace atlasgauge
