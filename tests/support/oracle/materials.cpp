#include "tests/support/oracle/materials.hpp"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace atlasgauge::oracle {
namespace {

namespace fs = std::filesystem;

std::string with_slashes(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

std::string join_path(const fs::path& folder, const std::string& name) {
  return (folder / name).lexically_normal().string();
}

bool is_file(const fs::path& path) {
  std::error_code ignored;  // a name may be too long for any file
  return fs::is_regular_file(path, ignored);
}

bool image_exists(const std::string& path, const Options& options) {
  return is_file(path) || (options.image_size && options.image_size(path));
}

std::string find_image(const std::string& name, const fs::path& mtl_folder,
                       const fs::path& obj_folder, const Options& options) {
  const std::string beside_mtl = join_path(mtl_folder, name);
  const std::string beside_obj = join_path(obj_folder, name);
  if (!image_exists(beside_mtl, options) && image_exists(beside_obj, options)) return beside_obj;
  return beside_mtl;
}

bool is_numeric(const std::string& word) {
  char* end = nullptr;
  std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0';
}

// The words that an option of a texture statement takes; -s, -o and -t take one to three, and a
// number that may be the last of these or the name is the name if nothing follows.
size_t option_arguments(const std::vector<std::string>& words, size_t option) {
  static const std::map<std::string, size_t> fixed = {
      {"-blendu", 1},  {"-blendv", 1}, {"-boost", 1},     {"-mm", 2},
      {"-texres", 1},  {"-clamp", 1},  {"-cc", 1},        {"-bm", 1},
      {"-imfchan", 1}, {"-type", 1},   {"-colorspace", 1}};
  if (const auto it = fixed.find(words[option]); it != fixed.end()) return it->second;
  if (words[option] != "-s" && words[option] != "-o" && words[option] != "-t") return 0;
  size_t count = 1;
  while (count < 3 && option + count + 2 < words.size() && is_numeric(words[option + count + 1])) {
    ++count;
  }
  return count;
}

std::string image_name_of(const std::string& rest) {
  const std::vector<std::string> words = words_of(rest);
  size_t first = 0;
  while (first < words.size() && words[first].starts_with('-')) {
    const size_t arguments = option_arguments(words, first);
    if (arguments == 0) break;
    first += 1 + arguments;
  }
  if (first >= words.size()) return "";
  return with_slashes(rest.substr(word_ranges(rest)[first].begin));
}

void read_mtl(const std::string& path, const fs::path& obj_folder, const Options& options,
              Materials& materials) {
  Material* current = nullptr;
  for (const Statement& statement : read_statements(path, Backslash::kPlain)) {
    if (statement.keyword == "newmtl") {
      const auto [it, is_new] = materials.by_name.try_emplace(statement.rest);
      if (is_new) materials.order.push_back(statement.rest);
      current = is_new ? &it->second : nullptr;
    } else if (statement.keyword == "map_Kd" && current) {
      const std::string name = image_name_of(statement.rest);
      const fs::path folder = fs::path(path).parent_path();
      if (!name.empty()) *current = {name, find_image(name, folder, obj_folder, options)};
    }
  }
}

std::vector<std::string> library_names(const std::string& rest, const fs::path& folder) {
  const std::vector<Word> words = word_ranges(rest);
  std::vector<std::string> names;
  size_t first = 0;
  while (first < words.size()) {
    size_t last = words.size();
    std::string name;
    for (; last > first; --last) {
      name =
          with_slashes(rest.substr(words[first].begin, words[last - 1].end - words[first].begin));
      if (is_file(folder / name)) break;
    }
    if (last > first) names.push_back(name);
    first = std::max(last, first + 1);
  }
  return names;
}

Slot named_slot(const Material& material, const Options& options) {
  Slot slot{material.image_name, material.image_path, std::nullopt, {}};
  if (options.image_size) slot.size = options.image_size(slot.path);
  if (slot.size && options.image_pixels) slot.pixels = options.image_pixels(slot.path);
  if (!slot.size) slot.size = options.size_option;
  return slot;
}

}  // namespace

Materials read_materials(const std::vector<Statement>& statements, const fs::path& obj_path,
                         const Options& options) {
  const fs::path folder = obj_path.parent_path();
  Materials materials;
  bool has_library = false;
  for (const Statement& statement : statements) {
    if (statement.keyword != "mtllib") continue;
    has_library = true;
    for (const std::string& name : library_names(statement.rest, folder)) {
      read_mtl((folder / name).string(), folder, options, materials);
    }
  }
  const fs::path own = fs::path(obj_path).replace_extension(".mtl");
  if (!has_library && is_file(own)) {
    read_mtl(own.string(), folder, options, materials);
  }
  return materials;
}

// The slots of the model, and the slot of each material that has one.
std::map<std::string, int64_t> make_slots(const Materials& materials, const Options& options,
                                          Model& model) {
  std::map<std::string, int64_t> by_path, by_material;
  for (const std::string& name : materials.order) {
    const Material& material = materials.by_name.at(name);
    if (material.image_name.empty()) continue;
    const auto next = static_cast<int64_t>(model.slots.size());
    const auto [it, is_new] = by_path.try_emplace(material.image_path, next);
    if (is_new) model.slots.push_back(named_slot(material, options));
    by_material[name] = it->second;
  }
  model.with_images = !model.slots.empty();
  model.counts_texels = model.with_images || options.size_option;
  if (!model.with_images) {
    model.slots.push_back({"N/A", "", options.size_option.value_or(Size{1, 1}), {}});
  }
  return by_material;
}

}  // namespace atlasgauge::oracle
