// Hostile models under a real limit of memory, as a user runs the program. Prints a row of a table
// for each.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/answers.hpp"
#include "bench/worst_cases.hpp"
#include "io/error.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"
#include "tests/support/worst_case_names.hpp"

namespace atlasgauge {

namespace {

namespace fs = std::filesystem;

constexpr long kLimitKib = 256 << 10;

std::uint64_t chosen_size() {
  const char* const text = std::getenv("ATLASGAUGE_WORST_SIZE");
  return text == nullptr ? 300'000 : std::stoull(text);
}

/// What -v says, as in "scratch alive at once        22.8 MiB".
std::string cost_in(const std::string& text, const std::string& label) {
  const std::size_t at = text.find(label);
  if (at == std::string::npos) return "-";
  const std::size_t begin = text.find_first_not_of(' ', at + label.size());
  return text.substr(begin, text.find("  ", begin) - begin);
}

class WorstCasesAtSizeTest : public testing::TestWithParam<WorstCase> {
 protected:
  WorstCasesAtSizeTest() {
    write_worst_case(GetParam(), size_, dir_.path().string());
    fs::create_directory(scratch());
  }

  std::string model() const { return (dir_.path() / GetParam().name).string() + ".obj"; }
  std::string scratch() const { return (dir_.path() / "scratch").string(); }

  ProgramResult run() const {
    std::vector<std::string> arguments{
        model(),   "--memory", "256M",   "--tmp-dir",
        scratch(), "-v",       "--json", (dir_.path() / "report.json").string()};
    if (const auto& size = GetParam().texture_size) {
      arguments.insert(arguments.end(), {"-t", fmt::format("{}x{}", size->width, size->height)});
    }
    return run_program(ATLASGAUGE_PROGRAM, arguments);
  }

  std::vector<std::string> wrong_answers() const {
    const nlohmann::json report = nlohmann::json::parse(std::ifstream(dir_.path() / "report.json"));
    return differences(report, worst_case_answers(GetParam(), size_));
  }

  void print_row(const ProgramResult& run) const {
    fmt::print("{}\t{} {}\t{} MiB\t{} MiB\t{} MiB\t{}\t{:.2f} us\t{:.1f} s\t{}\n", GetParam().name,
               size_, GetParam().unit, fs::file_size(model()) >> 20, kLimitKib >> 10,
               run.peak_resident_kib >> 10, cost_in(run.err, "scratch alive at once"),
               1e6 * run.cpu_seconds / static_cast<double>(size_), run.wall_seconds,
               HasFailure()                 ? "WRONG"
               : GetParam().refusal.empty() ? "right"
                                            : "refused");
  }

  TempDir dir_;
  const std::uint64_t size_ = chosen_size();
};

TEST_P(WorstCasesAtSizeTest, IsMeasuredOrRefusedWithinTheLimit) {
  const ProgramResult result = run();
  EXPECT_LE(result.peak_resident_kib, kLimitKib);
  EXPECT_TRUE(fs::is_empty(scratch()));
  if (GetParam().refusal.empty()) {
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(wrong_answers(), std::vector<std::string>{});
  } else {
    EXPECT_EQ(result.exit_code, static_cast<int>(ErrorKind::kInput));
    EXPECT_NE(result.err.find(GetParam().refusal), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(dir_.path() / "report.json"));
  }
  print_row(result);
}

INSTANTIATE_TEST_SUITE_P(All, WorstCasesAtSizeTest, testing::ValuesIn(worst_cases()), name_of);

}  // namespace
}  // namespace atlasgauge
