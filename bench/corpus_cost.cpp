// What a corpus of small models costs beyond its models: each measured for itself, one after the
// other, against `corpus run` over all of them.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "bench/answers.hpp"
#include "bench/child.hpp"
#include "bench/site.hpp"
#include "bench/temp_folder.hpp"
#include "bench/tool.hpp"
#include "io/error.hpp"

namespace {

using namespace atlasgauge;
namespace fs = std::filesystem;

struct Arguments {
  std::uint64_t models = 1000;
  std::uint64_t faces = 10'000;
  std::uint32_t texture_size = 0;
  std::string directory = scratch_directory();
  std::string program = ATLASGAUGE_PROGRAM;
};

struct Cost {
  double wall_seconds = 0, cpu_seconds = 0;

  void add(const ChildRun& run) {
    wall_seconds += run.wall_seconds;
    cpu_seconds += run.cpu_seconds();
  }
};

/// For models that name no image.
std::vector<std::string> texture_arguments(const Arguments& arguments) {
  if (arguments.texture_size > 0) return {};
  return {"-t", "1024x1024"};
}

std::vector<std::string> joined(std::vector<std::string> words,
                                const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

void describe(CLI::App& app, Arguments& arguments) {
  app.add_option("--models", arguments.models, "Models")->capture_default_str();
  app.add_option("--faces", arguments.faces, "Faces of each, about")->capture_default_str();
  app.add_option("--texture-size", arguments.texture_size,
                 "Side of the image of each, a power of two; 0: none")
      ->capture_default_str();
  app.add_option("--dir", arguments.directory, "Where models, job and scratch go")
      ->capture_default_str();
  app.add_option("--program", arguments.program, "The program")->capture_default_str();
}

std::string model_path(std::uint64_t i) {
  return fmt::format("RWT{:06}/site.obj", i);
}

/// Models of different shapes, as their seeds differ.
void make_corpus(const Arguments& arguments, const std::string& root) {
  SiteOptions options;
  options.image_format = arguments.texture_size > 0 ? ImageFormat::kJpg : ImageFormat::kNone;
  options.texture_size_texels = arguments.texture_size > 0 ? arguments.texture_size : 1024;
  for (std::uint64_t i = 0; i < arguments.models; ++i) {
    options.faces = arguments.faces;
    options.shuffle_seed = i;
    const fs::path folder = fs::path(root + "/" + model_path(i)).parent_path();
    fs::create_directories(folder);
    write_site(Site(options), folder.string());
  }
}

/// The measuring alone, on as many threads as a model of a corpus gets.
Cost measure_one_by_one(const Arguments& arguments, const std::string& root,
                        const std::string& scratch) {
  Cost cost;
  for (std::uint64_t i = 0; i < arguments.models; ++i) {
    const std::vector<std::string> command{arguments.program, root + "/" + model_path(i),
                                           "--json",          scratch + "/report.json",
                                           "--threads",       "1",
                                           "--memory",        "512M",
                                           "--tmp-dir",       scratch};
    cost.add(run_child_well(joined(command, texture_arguments(arguments)), scratch));
  }
  return cost;
}

Cost run_corpus(const Arguments& arguments, const std::string& job, std::size_t side_by_side,
                const std::string& scratch) {
  fs::remove_all(job + "/results");
  fs::create_directory(job + "/results");
  Cost cost;
  cost.add(
      run_child_well({arguments.program, "corpus", "run", job, "--jobs",
                      std::to_string(side_by_side), "--threads", std::to_string(side_by_side),
                      "--memory", fmt::format("{}M", 512 * side_by_side), "--tmp-dir", scratch},
                     scratch));
  return cost;
}

/// That every report of the job is right.
void check(const Arguments& arguments, const std::string& root, const std::string& job,
           const std::string& scratch) {
  const std::string reports = scratch + "/reports";
  run_child_well({arguments.program, "corpus", "gather", job, "--reports", reports}, scratch);
  for (std::uint64_t i = 0; i < arguments.models; ++i) {
    const std::string answers =
        fs::path(root + "/" + model_path(i)).replace_extension(".answers.json").string();
    const std::vector<std::string> wrong =
        differences_of_files(reports + "/" + model_path(i) + ".json", answers);
    if (!wrong.empty()) throw Error(ErrorKind::kInternal, model_path(i), 0, wrong.front());
  }
}

void print(const std::string& what, const Cost& cost, const Cost& own) {
  fmt::print("{:<32}{:>10.1f}{:>10.1f}{:>18.2f}\n", what, cost.wall_seconds, cost.cpu_seconds,
             cost.wall_seconds / own.wall_seconds);
}

int compare(const Arguments& arguments) {
  const TempFolder folder(arguments.directory);
  const std::string root = folder.path() + "/corpus", job = folder.path() + "/job";
  make_corpus(arguments, root);
  const std::vector<std::string> plan{arguments.program, "corpus", "plan", root, "--out", job};

  fmt::print("{} models of {} faces\n{:<32}{:>10}{:>10}{:>18}\n", arguments.models, arguments.faces,
             "", "wall, s", "CPU, s", "wall / their own");
  Cost planning;
  planning.add(run_child_well(joined(plan, texture_arguments(arguments)), folder.path()));
  const Cost own = measure_one_by_one(arguments, root, folder.path());
  print("each for itself", own, own);
  print("corpus plan", planning, own);
  for (const std::size_t jobs : {1U, std::max(1U, std::thread::hardware_concurrency())}) {
    print(fmt::format("corpus run --jobs {}", jobs),
          run_corpus(arguments, job, jobs, folder.path()), own);
  }
  check(arguments, root, job, folder.path());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Compares a corpus of small models with the sum of its models."};
  Arguments arguments;
  describe(app, arguments);
  return atlasgauge::run_tool("corpus_cost", app, argc, argv, [&] { return compare(arguments); });
}
