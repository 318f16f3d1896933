#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace atlasgauge {

/// Lets modules be found beside this program or in the folder above, where the main program is.
inline void show_modules(const char* file) {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const bool is_beside = std::filesystem::exists(folder / file);
  const auto module_folder = is_beside ? folder : folder.parent_path();
  ASSERT_EQ(::setenv("ATLASGAUGE_MODULE_DIR", module_folder.c_str(), 1), 0);
}

}  // namespace atlasgauge
