#include "io/progress_option.hpp"

namespace atlasgauge {

void add_progress_option(CLI::App& app, std::string& text) {
  app.add_option("--progress", text, "progress on standard error")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->type_name("auto|always|never");
}

ProgressMode progress_mode(const std::string& text) {
  if (text == "always") return ProgressMode::kAlways;
  return text == "never" ? ProgressMode::kNever : ProgressMode::kAuto;
}

}  // namespace atlasgauge
