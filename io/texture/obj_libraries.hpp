#pragma once

#include <string>
#include <vector>

namespace atlasgauge {

/// The material libraries of an OBJ.
struct ObjLibraries {
  std::vector<std::string> found;    ///< paths, each once, in the order named
  std::vector<std::string> missing;  ///< as spelled: see LibraryNames
};

/// Resolves the rests of `mtllib` lines, relative to the OBJ. Without such lines the library is the
/// one beside the OBJ with its name, if there is one.
ObjLibraries find_libraries(const std::string& obj_path,
                            const std::vector<std::string>& mtllib_lines);

/// Where files may come to lie that would then be libraries too: for all names in `missing`, and
/// without `mtllib` lines the library with the OBJ's name.
std::vector<std::string> places_of_missing_libraries(const std::string& obj_path,
                                                     const std::vector<std::string>& mtllib_lines);

}  // namespace atlasgauge
