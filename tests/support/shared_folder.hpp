#pragma once

#include <filesystem>

namespace atlasgauge {

/// Where the models to test against lie, beside the checkout; they may be missing.
inline std::filesystem::path shared_folder() {
  return std::filesystem::path(ATLASGAUGE_SOURCE_DIR).parent_path() / "shared";
}

}  // namespace atlasgauge
