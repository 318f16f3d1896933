// What other programs need for parts of the same work, beside ours.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/child.hpp"
#include "bench/peers/half_edges.hpp"
#include "bench/temp_folder.hpp"
#include "bench/text_file.hpp"
#include "bench/tool.hpp"
#include "io/bytes.hpp"
#include "io/error.hpp"

namespace {

using namespace atlasgauge;
namespace fs = std::filesystem;

struct Arguments {
  std::uint64_t faces = 1'000'000;
  std::uint64_t sort_faces = 4'000'000;
  std::string memory = "64M";
  std::string directory = scratch_directory();
  std::uint64_t repeat = 1;
  std::string json;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.add_option("--faces", arguments.faces, "Faces of the OBJ to read")->capture_default_str();
  app.add_option("--sort-faces", arguments.sort_faces, "Faces whose half-edges are sorted")
      ->capture_default_str();
  app.add_option("--memory", arguments.memory, "What sorting may use")->capture_default_str();
  app.add_option("--dir", arguments.directory, "Where files and scratch go")->capture_default_str();
  app.add_option("--repeat", arguments.repeat,
                 "Runs of each, of which the one with the median CPU is told")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--json", arguments.json, "Write all figures");
}

/// A program that does a part of the work.
struct Contender {
  std::string name;
  std::vector<std::string> command;

  bool installed() const { return fs::exists(command[0]); }
};

struct Result {
  std::string name;
  bool installed = false;
  ChildRun run;
};

ChildRun middle(std::vector<ChildRun> runs) {
  std::sort(runs.begin(), runs.end(),
            [](const ChildRun& a, const ChildRun& b) { return a.cpu_seconds() < b.cpu_seconds(); });
  return runs[runs.size() / 2];
}

/// A part of the work, done by several; the first is ours.
class Contest {
 public:
  Contest(std::string title, std::string item, std::uint64_t items)
      : title_(std::move(title)), item_(std::move(item)), items_(items) {}

  /// `answer_of` takes from a finished run what is held against `answer`.
  template <class AnswerOf>
  void enter(const Contender& contender, const Arguments& arguments, const std::string& folder,
             std::uint64_t answer, AnswerOf answer_of) {
    Result& result = results_.emplace_back();
    result.name = contender.name;
    result.installed = contender.installed();
    if (!result.installed) return;
    std::vector<ChildRun> runs;
    for (std::uint64_t i = 0; i < arguments.repeat; ++i) {
      runs.push_back(run_child_well(contender.command, folder));
      if (answer_of(runs.back()) != answer) {
        throw Error(ErrorKind::kInternal, contender.name + " has another answer: " + title_);
      }
    }
    result.run = middle(runs);
  }

  std::string table() const {
    std::string text = fmt::format("{:<40}{:>10}{:>10}{:>14}{:>18}{:>12}\n", title_, "CPU s",
                                   "wall s", "peak RSS", "ns per " + item_, "CPU / ours");
    const double ours = results_.front().run.cpu_seconds();
    for (const Result& result : results_) {
      text += fmt::format("  {:<38}", result.name);
      if (!result.installed) {
        text += "  not installed\n";
        continue;
      }
      const double cpu = result.run.cpu_seconds();
      text += fmt::format("{:>10.2f}{:>10.2f}{:>14}{:>18.1f}{:>12.1f}\n", cpu,
                          result.run.wall_seconds, format_bytes(result.run.peak_resident_bytes),
                          1e9 * cpu / static_cast<double>(items_), cpu / ours);
    }
    return text + "\n";
  }

  nlohmann::json json() const {
    nlohmann::json rows = nlohmann::json::array();
    for (const Result& result : results_) {
      nlohmann::json row{{"name", result.name}, {"installed", result.installed}};
      if (result.installed) {
        row["cpu_seconds"] = result.run.cpu_seconds();
        row["wall_seconds"] = result.run.wall_seconds;
        row["peak_resident_bytes"] = result.run.peak_resident_bytes;
      }
      rows.push_back(row);
    }
    return {{"title", title_}, {"item", item_}, {"items", items_}, {"rows", rows}};
  }

 private:
  std::string title_, item_;
  std::uint64_t items_;
  std::vector<Result> results_;
};

/// On the last line: STXXL has something to say before.
std::uint64_t printed_number(const ChildRun& run) {
  const std::size_t end = run.out.find_last_of('\n');
  if (end == std::string::npos) return 0;
  const std::size_t before = end == 0 ? std::string::npos : run.out.find_last_of('\n', end - 1);
  return std::strtoull(run.out.c_str() + (before == std::string::npos ? 0 : before + 1), nullptr,
                       10);
}

Contest read_obj(const Arguments& arguments) {
  const TempFolder folder(arguments.directory);
  run_child_well({ATLASGAUGE_MAKE_SITE, "--faces", std::to_string(arguments.faces),
                  "--texture-format", "none", "--texture-size", "8192", "--out", folder.path()},
                 folder.path());
  const std::string obj = folder.path() + "/site.obj";
  const auto answers = nlohmann::json::parse(std::ifstream(folder.path() + "/site.answers.json"));
  const auto faces = answers.at("values").at("fn").get<std::uint64_t>();
  Contest contest(fmt::format("reading an OBJ of {} faces", faces), "face", faces);
  for (const auto& [name, program] :
       {std::pair("atlasgauge", "own_reader"), std::pair("tinyobjloader", "tinyobj_reader"),
        std::pair("Assimp", "assimp_reader")}) {
    contest.enter({name, {program_beside(program), obj}}, arguments, folder.path(), faces,
                  printed_number);
  }
  return contest;
}

/// A line a half-edge, whose order as bytes is that of the half-edges.
void write_lines(const PeerGround& ground, const std::string& path) {
  TextFile file(path);
  ground.for_each([&](const PeerHalfEdge& half_edge) {
    file.put(fmt::format("{:08x} {:08x} {:08x}\n", half_edge.lo, half_edge.hi, half_edge.face));
  });
  file.close();
}

std::uint64_t edges_of_lines(const std::string& path) {
  std::ifstream file(path);
  EdgeCount edges;
  for (std::string line; std::getline(file, line);) {
    edges.add(static_cast<std::uint32_t>(std::stoul(line.substr(0, 8), nullptr, 16)),
              static_cast<std::uint32_t>(std::stoul(line.substr(9, 8), nullptr, 16)));
  }
  return edges.count();
}

Contest sort_half_edges(const Arguments& arguments) {
  const TempFolder folder(arguments.directory);
  const PeerGround ground(arguments.sort_faces);
  const std::string faces = std::to_string(arguments.sort_faces);
  const std::string memory = std::to_string(parse_bytes(arguments.memory));
  Contest contest(fmt::format("sorting {} half-edges in {}", ground.half_edges(),
                              format_bytes(parse_bytes(arguments.memory))),
                  "half-edge", ground.half_edges());
  for (const auto& [name, program] : {std::pair("atlasgauge, 16-byte records", "own_sort"),
                                      std::pair("STXXL, 16-byte records", "stxxl_sort")}) {
    contest.enter({name, {program_beside(program), faces, memory, folder.path()}}, arguments,
                  folder.path(), ground.edges(), printed_number);
  }
  const std::string lines = folder.path() + "/half_edges.txt",
                    sorted = folder.path() + "/sorted.txt";
  write_lines(ground, lines);
  contest.enter({"GNU sort, lines",
                 {"/usr/bin/sort", "-S", memory + "b", "-T", folder.path(), "-o", sorted, lines}},
                arguments, folder.path(), ground.edges(),
                [&](const ChildRun&) { return edges_of_lines(sorted); });
  return contest;
}

void compare(const Arguments& arguments) {
  nlohmann::json json = nlohmann::json::array();
  for (const auto part : {read_obj, sort_half_edges}) {
    const Contest contest = part(arguments);
    fmt::print("{}", contest.table());
    std::fflush(stdout);
    json.push_back(contest.json());
  }
  if (arguments.json.empty()) return;
  TextFile file(arguments.json);
  file.put(json.dump(1) + "\n");
  file.close();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Compares parts of atlasgauge with programs that do the same."};
  Arguments arguments;
  describe(app, arguments);
  return atlasgauge::run_tool("peers", app, argc, argv, [&] {
    ::setenv("LC_ALL", "C", 1);  // sort compares bytes then
    compare(arguments);
    return 0;
  });
}
