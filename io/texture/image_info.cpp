#include "io/texture/image_info.hpp"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "io/error.hpp"
#include "io/texture/image_module.hpp"

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

[[noreturn]] void fail_to_load(const std::string& reason) {
  throw Error(ErrorKind::kInternal, std::string("cannot load ") + kImageModuleFile +
                                        ", which reads images: " + reason +
                                        "; install the program again");
}

fs::path find_module() {
  for (const fs::path& folder : module_folders()) {
    std::error_code ignored;
    if (fs::exists(folder / kImageModuleFile, ignored)) return folder / kImageModuleFile;
  }
  fail_to_load("it lies neither beside the program nor in ../lib/atlasgauge");
}

std::string loader_error() {
  const char* text = ::dlerror();
  return text == nullptr ? "unknown reason" : text;
}

ImageSizeFunction load_module() {
  void* const module = ::dlopen(find_module().c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) fail_to_load(loader_error());
  void* const symbol = ::dlsym(module, kImageSizeSymbol);
  if (symbol == nullptr) fail_to_load(loader_error());
  return reinterpret_cast<ImageSizeFunction>(symbol);
}

}  // namespace

ImageSize read_image_size(const std::string& path) {
  static const ImageSizeFunction image_size = load_module();
  ImageSize size;
  std::array<char, 512> error{};
  if (!image_size(path.c_str(), &size.width, &size.height, error.data(), error.size())) {
    throw Error(ErrorKind::kInput, path, 0, std::string("cannot read the image: ") + error.data());
  }
  return size;
}

}  // namespace atlasgauge
