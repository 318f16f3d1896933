#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/corpus/input_digest.hpp"

namespace atlasgauge {

/// What a job must know of a model before it is measured.
struct ModelProbe {
  std::string path;    ///< from the root of the corpus
  double seconds = 0;  ///< that measuring it takes, as estimated
  InputDigest inputs;
};

/// A probe as text, for the pipe between a child process and its parent: a line a file, then one
/// that ends it.
std::string probe_text(const ModelProbe& probe);

/// All that ended in a text, which may be cut anywhere. Throws Error(kInternal) for another text.
std::vector<ModelProbe> read_probes(std::string_view text);

}  // namespace atlasgauge
