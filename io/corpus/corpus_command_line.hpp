#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/corpus/corpus_command.hpp"

namespace atlasgauge {

/// Parses what follows `corpus` on a command line: a command, or the text of its help. Opens no
/// file. Throws Error(kUsage).
std::variant<CorpusCommand, std::string> parse_corpus_command(std::vector<std::string> arguments);

}  // namespace atlasgauge
