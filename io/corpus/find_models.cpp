#include "io/corpus/find_models.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "io/error.hpp"
#include "io/suffix.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTileset = "tileset.json";
constexpr std::array<std::string_view, 10> kSuffixes{
    ".obj", ".obj.gz", ".obj.zst", ".ply", ".ply.gz", ".ply.zst", ".drc", ".gltf", ".glb", ".b3dm"};

bool is_model_name(const std::string& name) {
  const auto ends_name = [&](std::string_view suffix) { return has_suffix(name, suffix); };
  return name == kTileset || std::ranges::any_of(kSuffixes, ends_name);
}

bool matches(const std::string& pattern, const std::string& path, const std::string& name) {
  const bool of_path = pattern.find('/') != std::string::npos;
  return ::fnmatch(pattern.c_str(), (of_path ? path : name).c_str(), of_path ? FNM_PATHNAME : 0) ==
         0;
}

class Search {
 public:
  explicit Search(const ModelSearch& wanted) : wanted_(wanted) {
    std::error_code none;
    if (!wanted.left_out.empty()) left_out_ = fs::weakly_canonical(wanted.left_out, none);
  }

  FoundModels run() {
    if (!look_into(wanted_.root)) {
      throw Error(ErrorKind::kInput, wanted_.root, 0,
                  "the folder cannot be searched: " + fault_.message());
    }
    while (!folders_.empty()) {
      const fs::path folder = folders_.back();
      folders_.pop_back();
      if (!look_into(folder)) found_.unreadable.push_back(from_root(folder));
    }
    std::ranges::sort(found_.paths);
    std::ranges::sort(found_.unreadable);
    return std::move(found_);
  }

 private:
  /// Takes the models of a folder, and notes the folders in it. False if it cannot be read.
  bool look_into(const fs::path& folder) {
    std::error_code none;
    const bool is_tileset =
        wanted_.patterns.empty() && fs::is_regular_file(folder / kTileset, none);
    if (is_tileset) {
      found_.paths.push_back(from_root(folder / kTileset));
      return true;
    }
    fault_.clear();
    for (fs::directory_iterator entry(folder, fault_), end; !fault_ && entry != end;
         entry.increment(fault_)) {
      take(*entry);
    }
    return !fault_;
  }

  void take(const fs::directory_entry& entry) {
    std::error_code none;
    if (entry.is_directory(none)) {
      const bool is_link = entry.is_symlink(none);
      if (!is_link && !is_left_out(entry.path())) folders_.push_back(entry.path());
      return;
    }
    const std::string path = from_root(entry.path());
    if (entry.is_regular_file(none) && is_wanted(path)) found_.paths.push_back(path);
  }

  bool is_left_out(const fs::path& folder) const {
    std::error_code none;
    return !left_out_.empty() && fs::weakly_canonical(folder, none) == left_out_;
  }

  bool is_wanted(const std::string& path) const {
    const std::string name = path.substr(path.rfind('/') + 1);
    if (wanted_.patterns.empty()) return is_model_name(name);
    return std::ranges::any_of(
        wanted_.patterns, [&](const std::string& pattern) { return matches(pattern, path, name); });
  }

  std::string from_root(const fs::path& path) const {
    return path.lexically_relative(wanted_.root).string();
  }

  const ModelSearch& wanted_;
  fs::path left_out_;
  std::vector<fs::path> folders_;
  std::error_code fault_;
  FoundModels found_;
};

}  // namespace

FoundModels find_models(const ModelSearch& search) {
  return Search(search).run();
}

}  // namespace atlasgauge
