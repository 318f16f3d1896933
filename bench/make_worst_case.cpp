// Makes a hostile model with the answers that a report on it must give.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

#include "bench/tool.hpp"
#include "bench/worst_cases.hpp"
#include "io/error.hpp"

namespace {

using namespace atlasgauge;

struct Arguments {
  std::string name;
  std::uint64_t size = 1'000'000;
  std::string directory = ".";
  bool list = false;
};

void describe(CLI::App& app, Arguments& arguments) {
  auto* const list = app.add_flag("--list", arguments.list, "List the cases");
  app.add_option("--case", arguments.name, "What to make")->excludes(list);
  app.add_option("--size", arguments.size, "How many faces, vertices or bytes, by the case")
      ->capture_default_str();
  app.add_option("--out", arguments.directory, "Directory to write to")->capture_default_str();
}

void list_cases() {
  for (const WorstCase& worst_case : worst_cases()) {
    const auto& size = worst_case.texture_size;
    fmt::print("{:<24}{:<10}{:<14}{}\n", worst_case.name, worst_case.unit,
               size ? fmt::format("-t {}x{}", size->width, size->height) : "", worst_case.attacks);
  }
}

void make(const Arguments& arguments) {
  const WorstCase& worst_case = worst_case_of(arguments.name);
  std::error_code fault;
  std::filesystem::create_directories(arguments.directory, fault);
  if (fault) throw Error(ErrorKind::kResource, arguments.directory, 0, fault.message());
  write_worst_case(worst_case, arguments.size, arguments.directory);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Makes a hostile model with known answers, to be checked with make_site --check."};
  Arguments arguments;
  describe(app, arguments);
  return atlasgauge::run_tool("make_worst_case", app, argc, argv, [&] {
    arguments.list ? list_cases() : make(arguments);
    return 0;
  });
}
