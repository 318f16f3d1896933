// The program against reports of real models, made by other means.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/reference_reports.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

TEST(ReferenceTest, RealModelsAgree) {
  const std::vector<ReferenceReport> list = reference_reports();
  if (list.empty()) GTEST_SKIP() << "SKIPPED: no reference reports beside this checkout";
  const TempDir dir;
  const std::string report = (dir.path() / "report.json").string();
  for (const ReferenceReport& reference : list) {
    SCOPED_TRACE(reference.name);
    std::vector<std::string> arguments{reference.model.string(), "-q", "--json", report};
    arguments.insert(arguments.end(), reference.options.begin(), reference.options.end());
    const ProgramResult run = run_program(ATLASGAUGE_PROGRAM, arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::vector<std::string> differences = reference_differences(report, reference);
    EXPECT_EQ(differences, std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace atlasgauge
