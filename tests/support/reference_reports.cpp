#include "tests/support/reference_reports.hpp"

#include <fstream>
#include <sstream>

#include "tests/support/program.hpp"
#include "tests/support/shared_folder.hpp"

namespace atlasgauge {
namespace {

ReferenceReport parse_entry(const std::string& line) {
  std::istringstream fields(line);
  std::string model, report, options;
  std::getline(fields, model, '\t');
  std::getline(fields, report, '\t');
  std::getline(fields, options, '\t');
  ReferenceReport entry{
      model, shared_folder() / "data" / model, shared_folder() / "reference" / report, {}};
  std::istringstream words(options);
  for (std::string word; words >> word;) entry.options.push_back(word);
  return entry;
}

}  // namespace

std::vector<ReferenceReport> reference_reports() {
  std::ifstream index(shared_folder() / "reference/INDEX.tsv");
  std::vector<ReferenceReport> list;
  std::string line;
  std::getline(index, line);
  while (std::getline(index, line)) list.push_back(parse_entry(line));
  return list;
}

std::vector<std::string> reference_differences(const std::filesystem::path& report,
                                               const ReferenceReport& reference) {
  const std::string compare = (shared_folder() / "reference/compare.py").string();
  const ProgramResult result =
      run_program("/usr/bin/python3", {compare, report.string(), reference.report.string()});
  std::istringstream lines(result.out);
  std::vector<std::string> differences;
  for (std::string line; std::getline(lines, line);) {
    if (line != "agrees") differences.push_back(line);
  }
  if (!result.err.empty()) differences.push_back(result.err);
  return differences;
}

}  // namespace atlasgauge
