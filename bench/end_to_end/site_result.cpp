#include "bench/end_to_end/site_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/bytes.hpp"

namespace atlasgauge {
namespace {

/// The middle of these, or the mean of the two in the middle.
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

template <class Figure>
double median(const std::vector<RunFigures>& runs, Figure figure) {
  std::vector<double> values;
  for (const RunFigures& run : runs) values.push_back(figure(run));
  return median(std::move(values));
}

std::string bytes(double count) {
  return format_bytes(static_cast<std::uint64_t>(count));
}

nlohmann::json to_json(const StageFigures& stage) {
  return {{"name", stage.name},
          {"wall_seconds", stage.wall_seconds},
          {"cpu_seconds", stage.cpu_seconds},
          {"workers", stage.workers},
          {"spilled_bytes", stage.spilled_bytes},
          {"written_bytes", stage.written_bytes},
          {"read_bytes", stage.read_bytes}};
}

nlohmann::json to_json(const RunFigures& run) {
  nlohmann::json json{{"wall_seconds", run.wall_seconds},
                      {"user_seconds", run.user_seconds},
                      {"system_seconds", run.system_seconds},
                      {"peak_resident_bytes", run.peak_resident_bytes},
                      {"bytes", run.cost.bytes},
                      {"stages", nlohmann::json::array()}};
  for (const StageFigures& stage : run.cost.stages) json["stages"].push_back(to_json(stage));
  return json;
}

std::string ratio(double a, double b) {
  return b > 0 ? fmt::format("{:.2f}", a / b) : "-";
}

/// The wall and CPU times of one stage at each number of threads.
std::string stage_row(const std::string& name, const std::vector<double>& wall,
                      const std::vector<double>& cpu, double faces) {
  std::string line = fmt::format("  {:<16}", name);
  for (std::size_t i = 0; i < wall.size(); ++i) {
    line += fmt::format("{:>10.3f}{:>10.3f}{:>11.3f}", wall[i], cpu[i], 1e6 * cpu[i] / faces);
  }
  if (wall.size() > 1) line += fmt::format("{:>8}", ratio(wall.front(), wall.back()));
  return line + "\n";
}

}  // namespace

RunFigures median_of(const std::vector<RunFigures>& runs) {
  RunFigures result = runs.front();
  result.wall_seconds = median(runs, [](const RunFigures& r) { return r.wall_seconds; });
  result.user_seconds = median(runs, [](const RunFigures& r) { return r.user_seconds; });
  result.system_seconds = median(runs, [](const RunFigures& r) { return r.system_seconds; });
  result.peak_resident_bytes =
      median(runs, [](const RunFigures& r) { return r.peak_resident_bytes; });
  for (auto& line : result.cost.bytes) {
    line.second = median(runs, [&](const RunFigures& r) { return r.cost.bytes_of(line.first); });
  }
  for (std::size_t i = 0; i < result.cost.stages.size(); ++i) {
    const auto of_stage = [&](auto figure) {
      return median(runs, [&](const RunFigures& r) { return r.cost.stages.at(i).*figure; });
    };
    StageFigures& stage = result.cost.stages[i];
    stage.wall_seconds = of_stage(&StageFigures::wall_seconds);
    stage.cpu_seconds = of_stage(&StageFigures::cpu_seconds);
  }
  return result;
}

nlohmann::json to_json(const SiteResult& result) {
  const SitePlan& site = result.site;
  nlohmann::json json{{"multiple", result.multiple},
                      {"budget_bytes", result.budget_bytes},
                      {"faces", site.faces},
                      {"obj_bytes", site.obj_bytes},
                      {"textures", site.textures},
                      {"texture_size", site.texture_size_texels},
                      {"texture_format", site.texture_format},
                      {"threads", result.threads},
                      {"median", to_json(median_of(result.runs))},
                      {"runs", nlohmann::json::array()}};
  for (const RunFigures& run : result.runs) json["runs"].push_back(to_json(run));
  return json;
}

std::string table_of(const std::vector<SiteResult>& results) {
  std::string text =
      fmt::format("{:>8}{:>11}{:>13}{:>8}{:>10}{:>10}{:>12}{:>13}{:>13}{:>13}{:>13}\n", "x budget",
                  "OBJ", "faces", "threads", "wall s", "CPU s", "faces/s", "CPU us/face",
                  "peak RSS", "written", "read");
  for (const SiteResult& result : results) {
    const RunFigures run = median_of(result.runs);
    const auto faces = static_cast<double>(result.site.faces);
    const auto obj_bytes = static_cast<double>(result.site.obj_bytes);
    text += fmt::format(
        "{:>8.3g}{:>11}{:>13}{:>8}{:>10.2f}{:>10.2f}{:>12.0f}{:>13.3f}{:>13}{:>13}{:>13}\n",
        obj_bytes / result.budget_bytes, bytes(obj_bytes), result.site.faces, result.threads,
        run.wall_seconds, run.cpu_seconds(), faces / run.wall_seconds,
        1e6 * run.cpu_seconds() / faces, bytes(run.peak_resident_bytes),
        bytes(run.cost.bytes_of("scratch written")), bytes(run.cost.bytes_of("scratch read")));
  }
  return text;
}

std::string stage_table_of(const std::vector<SiteResult>& of_one_site) {
  std::vector<RunFigures> runs;
  std::string text = fmt::format("  {:<16}", "stage");
  for (const SiteResult& result : of_one_site) {
    runs.push_back(median_of(result.runs));
    text += fmt::format("{:>10}{:>10}{:>11}", fmt::format("wall s, {}", result.threads), "CPU s",
                        "us/face");
  }
  text += runs.size() > 1 ? fmt::format("{:>8}\n", "ratio") : "\n";
  const auto faces = static_cast<double>(of_one_site.front().site.faces);
  const auto row = [&](const std::string& name, auto wall_of, auto cpu_of) {
    std::vector<double> wall, cpu;
    for (const RunFigures& run : runs) {
      wall.push_back(wall_of(run));
      cpu.push_back(cpu_of(run));
    }
    text += stage_row(name, wall, cpu, faces);
  };
  for (std::size_t i = 0; i < runs.front().cost.stages.size(); ++i) {
    row(
        runs.front().cost.stages[i].name,
        [i](const RunFigures& run) { return run.cost.stages.at(i).wall_seconds; },
        [i](const RunFigures& run) { return run.cost.stages.at(i).cpu_seconds; });
  }
  row(
      "whole program", [](const RunFigures& run) { return run.wall_seconds; },
      [](const RunFigures& run) { return run.cpu_seconds(); });
  return text;
}

}  // namespace atlasgauge
