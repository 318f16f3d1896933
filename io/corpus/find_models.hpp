#pragma once

#include <string>
#include <vector>

namespace atlasgauge {

/// What to look for in a folder.
struct ModelSearch {
  std::string root;
  /// Patterns (*, ?, [...]) for names, or for paths from the root where they hold a slash; none:
  /// everything that this program measures. A name in the patterns of a user is a model wherever it
  /// lies; otherwise a folder with a tileset.json is one model, and all below it belongs to that.
  std::vector<std::string> patterns;
  std::string left_out;  ///< a folder that is not searched: the job's own
};

/// What was found.
struct FoundModels {
  std::vector<std::string> paths;       ///< from the root, sorted byte by byte
  std::vector<std::string> unreadable;  ///< folders that cannot be searched
};

/// Files, and links to files; links to folders are not followed. Throws Error(kInput) where the
/// root cannot be searched.
FoundModels find_models(const ModelSearch& search);

}  // namespace atlasgauge
