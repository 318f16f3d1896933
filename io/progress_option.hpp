#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "io/progress_bar.hpp"

namespace atlasgauge {

/// Describes --progress, whose text goes to `text`.
void add_progress_option(CLI::App& app, std::string& text);

/// What the text says, once it is checked.
ProgressMode progress_mode(const std::string& text);

}  // namespace atlasgauge
