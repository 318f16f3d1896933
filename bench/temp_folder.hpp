#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "io/error.hpp"

namespace atlasgauge {

/// Where scratch goes unless told: to a disk, as a run's does.
inline std::string scratch_directory() {
  const char* folder = std::getenv("TMPDIR");
  return folder != nullptr && *folder != '\0' ? folder : "/var/tmp";
}

/// A folder that is removed with all it holds.
class TempFolder {
 public:
  explicit TempFolder(const std::string& inside = scratch_directory()) {
    std::string name = inside + "/atlasgauge_bench_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw Error(ErrorKind::kResource, name, 0, errno_text());
    path_ = name;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace atlasgauge
