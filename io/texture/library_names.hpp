#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace atlasgauge {

/// File names in the rest of an `mtllib` line, in order.
struct LibraryNames {
  std::vector<std::string> found;
  std::vector<std::string> missing;  ///< runs of words between those found
};

/// The names are separated by blanks, but may hold blanks themselves. The whole text is one name if
/// such a file exists, else the longest runs of words that exist. A name may stand in quotes, and
/// have backslashes for slashes or before its spaces ("my\ file.mtl").
LibraryNames split_library_names(std::string_view text,
                                 const std::function<bool(const std::string& name)>& exists);

/// What may be meant by a run of words that split_library_names() found missing: all of it, or each
/// of its words, in every spelling that is tried.
std::vector<std::string> possible_library_names(std::string_view missing);

}  // namespace atlasgauge
