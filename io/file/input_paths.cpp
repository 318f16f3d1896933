#include "io/file/input_paths.hpp"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

bool is_pattern(const std::string& name) {
  std::error_code error;
  return name.find_first_of("*?[") != std::string::npos && !std::filesystem::exists(name, error);
}

std::vector<std::string> matches(const std::string& pattern) {
  ::glob_t found{};
  const int fault = ::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found);
  const std::unique_ptr<::glob_t, void (*)(::glob_t*)> release(&found, ::globfree);
  if (fault == GLOB_NOSPACE) throw std::bad_alloc();
  if (fault != 0 || found.gl_pathc == 0) {
    throw Error(ErrorKind::kInput, pattern, 0, "no file matches this pattern");
  }
  std::vector<std::string> paths(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  std::ranges::sort(paths);
  return paths;
}

}  // namespace

std::vector<std::string> expand_input_paths(const std::vector<std::string>& names) {
  std::vector<std::string> paths;
  for (const std::string& name : names) {
    if (!is_pattern(name)) {
      paths.push_back(name);
      continue;
    }
    const std::vector<std::string> all = matches(name);
    paths.insert(paths.end(), all.begin(), all.end());
  }
  return paths;
}

}  // namespace atlasgauge
