// Reports of real models, made by other means. They are not in the repository: the folder `shared`
// lies beside the checkout where they are at hand, else this test says that it is skipped.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

struct Reference {
  std::string model, report, options;
};

std::filesystem::path shared_folder() {
  return std::filesystem::path(ATLASGAUGE_SOURCE_DIR).parent_path() / "shared";
}

std::vector<Reference> references() {
  std::ifstream index(shared_folder() / "reference/INDEX.tsv");
  std::vector<Reference> list;
  std::string line;
  std::getline(index, line);
  while (std::getline(index, line)) {
    std::istringstream fields(line);
    Reference reference;
    std::getline(fields, reference.model, '\t');
    std::getline(fields, reference.report, '\t');
    std::getline(fields, reference.options, '\t');
    list.push_back(reference);
  }
  return list;
}

/// Keys that the raster or the seam colours decide: they are not measured yet.
bool is_pending(const std::string& line) {
  return line.starts_with("texture_0") || line.starts_with("occupancy") ||
         line.starts_with("sf_") || line.starts_with("seam_discrepancy") ||
         (line.starts_with("texture_") && line.find(" levels:") != std::string::npos);
}

std::string differences(const std::string& report, const std::filesystem::path& reference) {
  const ProgramResult compare = run_program(
      "/usr/bin/python3",
      {(shared_folder() / "reference/compare.py").string(), report, reference.string()});
  std::istringstream lines(compare.out);
  std::string left;
  for (std::string line; std::getline(lines, line);) {
    if (line != "agrees" && !is_pending(line)) left += line + "\n";
  }
  return left + compare.err;
}

TEST(ReferenceTest, RealModelsAgree) {
  const std::vector<Reference> list = references();
  if (list.empty()) GTEST_SKIP() << "SKIPPED: no reference reports beside this checkout";
  const TempDir dir;
  const std::string report = (dir.path() / "report.json").string();
  for (const Reference& reference : list) {
    SCOPED_TRACE(reference.model);
    std::vector<std::string> arguments{(shared_folder() / "data" / reference.model).string(), "-q",
                                       "--json", report};
    std::istringstream options(reference.options);
    for (std::string option; options >> option;) arguments.push_back(option);
    const ProgramResult run = run_program(ATLASGAUGE_PROGRAM, arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(differences(report, shared_folder() / "reference" / reference.report), "");
  }
}

}  // namespace
}  // namespace atlasgauge
