#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Reports of real models, made by other means. They are not in the repository: they lie in the
// folder `shared` beside the checkout where they are at hand.
namespace atlasgauge {

struct ReferenceReport {
  std::string name;  ///< of the model, as the list has it
  std::filesystem::path model, report;
  std::vector<std::string> options;  ///< of the command line
};

/// Empty where they are not at hand.
std::vector<ReferenceReport> reference_reports();

/// What the comparison that comes with the references finds between a report and a reference: lines
/// that begin with a key.
std::vector<std::string> reference_differences(const std::filesystem::path& report,
                                               const ReferenceReport& reference);

}  // namespace atlasgauge
