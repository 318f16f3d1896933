#include "io/file/module.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

/// Folders of an installed module: lib/atlasgauge, or lib/<architecture>/atlasgauge.
void add_library_folders(const fs::path& lib, std::vector<fs::path>& folders) {
  folders.push_back(lib / "atlasgauge");
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(lib, ignored)) {
    folders.push_back(entry.path() / "atlasgauge");
  }
}

std::vector<fs::path> module_folders() {
  std::vector<fs::path> folders;
  // Set by tests, whose programs lie elsewhere.
  if (const char* folder = std::getenv("ATLASGAUGE_MODULE_DIR")) folders.emplace_back(folder);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return folders;
  const fs::path folder = program.parent_path();
  folders.push_back(folder);
  add_library_folders(folder.parent_path() / "lib", folders);
  add_library_folders(folder.parent_path() / "lib64", folders);
  return folders;
}

[[noreturn]] void fail_to_load(const Module& module, const std::string& reason) {
  throw Error(ErrorKind::kResource, std::string("cannot load ") + module.file + ", which " +
                                        module.purpose + ": " + reason + "; " + module.remedy);
}

std::string loader_error() {
  const char* text = ::dlerror();
  return text == nullptr ? "unknown reason" : text;
}

}  // namespace

std::optional<std::string> module_path(const Module& module) {
  for (const fs::path& folder : module_folders()) {
    std::error_code ignored;
    if (fs::exists(folder / module.file, ignored)) return (folder / module.file).string();
  }
  return std::nullopt;
}

void* module_symbol(const Module& module, const char* symbol) {
  const std::optional<std::string> path = module_path(module);
  if (!path) fail_to_load(module, "it lies neither beside the program nor in ../lib/atlasgauge");
  void* const handle = ::dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) fail_to_load(module, loader_error());
  void* const found = ::dlsym(handle, symbol);
  if (found == nullptr) fail_to_load(module, loader_error());
  return found;
}

}  // namespace atlasgauge
