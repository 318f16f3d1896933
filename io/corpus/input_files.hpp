#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/open_parts.hpp"

namespace atlasgauge {

/// All files that measuring a model would read, and those that it names but that are missing: the
/// report would change if they appeared. Each once: the model, then the files of its geometry or
/// its libraries, in the order named, then its images, in that order.
///
/// - A missing image is listed where it would be looked for first.
/// - So is a missing library. Where a line of several names leaves open which words are a name, all
///   of the words and each of them is listed.
/// - A file that would be found before the one that is, is listed as missing: an image of an OBJ
///   beside each of its libraries, one with the model's own name in every spelling that is tried.
/// - Names longer than the system takes are not listed.
struct ModelInputs {
  std::vector<std::string> files;
  std::optional<std::string> fault;  ///< why there may be more
};

/// Reads as much of a model as it takes to know: all text of an OBJ, but only the values beside its
/// `mtllib` lines; of others the headers and JSON. So a model without a fault here may have one
/// when it is measured. Holds a block of text and the names of files, as long as a model may have
/// (NameRoom). Finds libraries and images by the functions that serve measuring.
ModelInputs list_model_inputs(const std::string& model, const PartOptions& options);

}  // namespace atlasgauge
