// Measures the program on generated sites of multiples of a memory budget, and checks every report
// against the answers of its site.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/answers.hpp"
#include "bench/child.hpp"
#include "bench/end_to_end/site_plan.hpp"
#include "bench/end_to_end/site_result.hpp"
#include "bench/temp_folder.hpp"
#include "bench/tool.hpp"
#include "io/bytes.hpp"
#include "io/error.hpp"

namespace {

using namespace atlasgauge;
namespace fs = std::filesystem;

struct Arguments {
  std::string program = ATLASGAUGE_PROGRAM;
  std::string make_site = ATLASGAUGE_MAKE_SITE;
  std::vector<double> multiples{0.25, 1, 4};
  std::string memory = "256M";
  std::string directory = scratch_directory();
  std::uint64_t textures = 0;  ///< 0: in proportion to the faces
  std::uint64_t texture_size_texels = 2048;
  std::string texture_format = "jpg";
  std::vector<std::uint64_t> threads{2};
  std::uint64_t repeat = 1;
  std::string json;
  std::vector<std::string> site_options, program_options;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.add_option("--multiples", arguments.multiples, "OBJ bytes over the memory limit")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--memory", arguments.memory, "The limit of the program")->capture_default_str();
  app.add_option("--dir", arguments.directory, "Where sites and scratch go")->capture_default_str();
  app.add_option("--textures", arguments.textures, "Images of a site; else 8 texels a face");
  app.add_option("--texture-size", arguments.texture_size_texels, "Their side")
      ->capture_default_str();
  app.add_option("--texture-format", arguments.texture_format, "jpg, png, or none")
      ->check(CLI::IsMember({"jpg", "png", "none"}))
      ->capture_default_str();
  app.add_option("--threads", arguments.threads, "1,2 measures with one and with two")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--repeat", arguments.repeat, "Runs of each; figures are medians")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--json", arguments.json, "Write all figures");
  app.add_option("--program", arguments.program, "What to measure")->capture_default_str();
  app.add_option("--site", arguments.site_options,
                 "An option for make_site, as --site=--shuffle-faces=1");
  app.add_option("--pass", arguments.program_options,
                 "An option for the program, as --pass=--engine-memory=8M");
}

SitePlan plan_site(const Arguments& arguments, double multiple) {
  SitePlan site;
  site.obj_bytes =
      static_cast<std::uint64_t>(multiple * static_cast<double>(parse_bytes(arguments.memory)));
  site.faces = faces_of_obj(static_cast<double>(site.obj_bytes));
  site.texture_size_texels = arguments.texture_size_texels;
  site.texture_format = arguments.texture_format;
  site.textures = arguments.textures > 0 ? arguments.textures
                                         : textures_for(site.faces, site.texture_size_texels);
  if (site.texture_format == "none") site.textures = 1;
  return site;
}

/// A site on disk as long as this lives.
class MadeSite {
 public:
  MadeSite(const Arguments& arguments, const SitePlan& plan)
      : folder_(arguments.directory), plan_(plan) {
    std::vector<std::string> command{arguments.make_site,
                                     "--faces",
                                     std::to_string(plan.faces),
                                     "--textures",
                                     std::to_string(plan.textures),
                                     "--texture-size",
                                     std::to_string(plan.texture_size_texels),
                                     "--texture-format",
                                     plan.texture_format,
                                     "--out",
                                     folder_.path()};
    command.insert(command.end(), arguments.site_options.begin(), arguments.site_options.end());
    run_child_well(command, folder_.path());
    plan_.obj_bytes = fs::file_size(obj());
    const auto answers = nlohmann::json::parse(std::ifstream(answers_file()));
    plan_.faces = answers.at("values").at("fn").get<std::uint64_t>();
  }

  const SitePlan& plan() const { return plan_; }
  const std::string& folder() const { return folder_.path(); }
  std::string obj() const { return folder() + "/site.obj"; }
  std::string answers_file() const { return folder() + "/site.answers.json"; }

 private:
  TempFolder folder_;
  SitePlan plan_;
};

std::vector<std::string> command_for(const Arguments& arguments, const MadeSite& site,
                                     std::uint64_t threads, const std::string& report) {
  std::vector<std::string> command{
      arguments.program, site.obj(),       "--json",    report,
      "--memory",        arguments.memory, "--threads", std::to_string(threads),
      "--tmp-dir",       site.folder(),    "-v"};
  if (site.plan().texture_format == "none") {
    const std::string side = std::to_string(site.plan().texture_size_texels);
    command.insert(command.end(), {"-t", side + "x" + side});
  }
  command.insert(command.end(), arguments.program_options.begin(), arguments.program_options.end());
  return command;
}

void check_report(const std::string& report, const MadeSite& site) {
  const std::vector<std::string> lines = differences_of_files(report, site.answers_file());
  if (lines.empty()) return;
  throw Error(ErrorKind::kInternal,
              fmt::format("the report is wrong:\n{}", fmt::join(lines, "\n")));
}

RunFigures run_once(const Arguments& arguments, const MadeSite& site, std::uint64_t threads) {
  const std::string report = site.folder() + "/report.json";
  const ChildRun child =
      run_child_well(command_for(arguments, site, threads, report), site.folder());
  check_report(report, site);
  return {child.wall_seconds, child.user_seconds, child.system_seconds,
          static_cast<double>(child.peak_resident_bytes), parse_cost(child.err)};
}

std::vector<SiteResult> measure_site(const Arguments& arguments, double multiple) {
  const MadeSite site(arguments, plan_site(arguments, multiple));
  std::vector<SiteResult> results;
  for (const std::uint64_t threads : arguments.threads) {
    SiteResult& result = results.emplace_back();
    result.site = site.plan();
    result.multiple = multiple;
    result.budget_bytes = static_cast<double>(parse_bytes(arguments.memory));
    result.threads = threads;
  }
  // By turns, so that what else the machine does meets all alike.
  for (std::uint64_t i = 0; i < arguments.repeat; ++i) {
    for (SiteResult& result : results) {
      result.runs.push_back(run_once(arguments, site, result.threads));
    }
  }
  return results;
}

/// What is said of a site that the disk cannot hold; empty if it can.
std::string too_large(const Arguments& arguments, double multiple) {
  const std::uint64_t need = plan_site(arguments, multiple).disk_bytes();
  const std::uint64_t free = fs::space(arguments.directory).available;
  if (need <= free) return {};
  return fmt::format("{} x budget: left out, as it needs {} of disk, and {} has {}", multiple,
                     format_bytes(need), arguments.directory, format_bytes(free));
}

void write_json(const std::string& path, const nlohmann::json& json) {
  std::ofstream file(path);
  file << json.dump(1) << '\n';
  if (!file.flush()) throw Error(ErrorKind::kResource, path, 0, errno_text());
}

void measure(const Arguments& arguments) {
  std::vector<SiteResult> all;
  nlohmann::json json{{"sites", nlohmann::json::array()}, {"left_out", nlohmann::json::array()}};
  for (const double multiple : arguments.multiples) {
    if (const std::string reason = too_large(arguments, multiple); !reason.empty()) {
      fmt::print("{}\n\n", reason);
      json["left_out"].push_back(reason);
      continue;
    }
    const std::vector<SiteResult> results = measure_site(arguments, multiple);
    const SitePlan& site = results.front().site;
    fmt::print("{} x budget: {} faces, {} textures of {} texels\n{}\n", multiple, site.faces,
               site.textures, site.texture_size_texels, stage_table_of(results));
    std::fflush(stdout);
    for (const SiteResult& result : results) json["sites"].push_back(to_json(result));
    all.insert(all.end(), results.begin(), results.end());
  }
  fmt::print("{}", table_of(all));
  if (!arguments.json.empty()) write_json(arguments.json, json);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures atlasgauge on sites of multiples of its memory limit."};
  Arguments arguments;
  describe(app, arguments);
  return atlasgauge::run_tool("end_to_end", app, argc, argv, [&] {
    measure(arguments);
    return 0;
  });
}
