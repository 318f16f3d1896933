// Folders are the direction of flow: a file includes from its own folder and from those before it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace atlasgauge {
namespace {

const std::vector<std::string> kFlow{"io", "stream", "measures"};

/// Position of a project folder in the flow; past the end for any other include.
std::size_t place_of(const std::string& path) {
  const std::string folder = path.substr(0, path.find('/'));
  return static_cast<std::size_t>(std::find(kFlow.begin(), kFlow.end(), folder) - kFlow.begin());
}

std::vector<std::string> project_includes(const std::filesystem::path& file) {
  std::vector<std::string> includes;
  std::ifstream text(file);
  const std::string start = "#include \"";
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with(start)) {
      includes.push_back(line.substr(start.size(), line.rfind('"') - start.size()));
    }
  }
  return includes;
}

TEST(LayeringTest, IncludesPointUpstream) {
  const std::filesystem::path root = ATLASGAUGE_SOURCE_DIR;
  std::size_t files = 0;
  for (std::size_t place = 0; place < kFlow.size(); ++place) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / kFlow[place])) {
      if (!entry.is_regular_file()) continue;
      ++files;
      for (const std::string& include : project_includes(entry.path())) {
        EXPECT_LE(place_of(include), place) << entry.path() << " includes " << include;
      }
    }
  }
  EXPECT_GT(files, 50U);
}

}  // namespace
}  // namespace atlasgauge
