#include "io/corpus/input_files.hpp"

#include <climits>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "io/error.hpp"
#include "io/file/byte_range.hpp"
#include "io/file/file_listener.hpp"
#include "io/file/file_path.hpp"
#include "io/name_room.hpp"
#include "io/obj/obj_reader.hpp"
#include "io/texture/obj_libraries.hpp"
#include "io/texture/texture_slots.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

/// Files in the order in which they come, each once.
class FileList {
 public:
  explicit FileList(const std::string& model) : room_(model) {}

  /// No file has a longer path than the system takes.
  void add(const std::string& path) {
    if (path.size() >= PATH_MAX) return;
    std::string key = one_spelling(path);
    if (known_.contains(key)) return;
    room_.add(path.size() + key.size());
    known_.insert(std::move(key));
    files_.push_back(path);
  }

  std::vector<std::string> take() { return std::move(files_); }

 private:
  NameRoom room_;
  std::unordered_set<std::string> known_;  // in one spelling
  std::vector<std::string> files_;
};

/// Takes values and forgets them.
class NoSink : public MeshSink {
 public:
  void add(const MeshBatch&) override {}
};

/// Whether a line of the block may name a library. Pieces of a line may, whatever they hold: only
/// the first has its keyword.
bool may_name_library(const ObjBlock& block) {
  if (block.kind != ObjBlock::Kind::kWholeLines) return true;
  return std::string_view(block.text.data(), block.text.size()).find("mtllib") !=
         std::string_view::npos;
}

void read_libraries(ObjReader& reader) {
  NoSink sink;
  ObjBlock block;
  while (reader.next(block)) {
    if (!may_name_library(block)) continue;
    reader.parse(block);
    reader.commit(block, sink);
  }
}

/// Calls a step, and says what fault of the input ended it.
std::optional<std::string> fault_of(const std::function<void()>& step) {
  try {
    step();
    return std::nullopt;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput && error.kind() != ErrorKind::kResource) throw;
    return error.what();
  }
}

/// Images as a measuring run finds them, without a look at what they hold.
TextureSlots find_images(InputMaterials materials, Warnings& warnings) {
  const auto no_probe = [](const ImageSource&) { return ImageHeader{}; };
  TextureSlots found = resolve_textures({&materials, 1}, std::nullopt, no_probe, warnings);
  if (!found.has_images) found.slots.clear();
  return found;
}

void add_images(InputMaterials materials, FileList& files, Warnings& warnings) {
  const TextureSlots images = find_images(std::move(materials), warnings);
  for (const TextureSlot& slot : images.slots) files.add(slot.source.path);
}

/// An image is sought beside the library before it is beside the model: that is where one would
/// come first.
void add_images_of_obj(InputMaterials materials, const std::vector<std::string>& libraries,
                       FileList& files, Warnings& warnings) {
  const TextureSlots images = find_images(std::move(materials), warnings);
  for (const TextureSlot& slot : images.slots) {
    files.add(slot.source.path);
    for (const std::string& library : libraries) {
      files.add(std::filesystem::path(library).replace_filename(slot.name).string());
    }
  }
}

/// The `mtllib` lines up to a fault, if there is one.
struct LibraryLines {
  std::vector<std::string> lines;
  std::optional<std::string> fault;
};

LibraryLines find_library_lines(const std::string& path, Warnings& warnings) {
  const std::unique_ptr<ByteSource> source = open_byte_source(path);
  ObjReader reader(*source, path, warnings, kBlockBytes);
  LibraryLines result;
  result.fault = fault_of([&] { read_libraries(reader); });
  result.lines = reader.take_mtllib_lines();
  return result;
}

std::optional<std::string> list_obj(const std::string& path, FileList& files, Warnings& warnings) {
  LibraryLines libraries = find_library_lines(path, warnings);
  const std::vector<std::string> found = find_libraries(path, libraries.lines).found;
  for (const std::string& library : found) files.add(library);
  for (const std::string& place : places_of_missing_libraries(path, libraries.lines)) {
    files.add(place);
  }
  add_images_of_obj({path, ObjMaterials{std::move(libraries.lines), {}}}, found, files, warnings);
  return libraries.fault;
}

std::optional<std::string> list_parts(const std::string& path, PartReader& parts, FileList& files,
                                      Warnings& warnings) {
  std::optional<std::string> fault = fault_of([&] {
    while (parts.next() != nullptr) {
    }
  });
  add_images({path, parts.materials()}, files, warnings);
  return fault;
}

}  // namespace

ModelInputs list_model_inputs(const std::string& model, const PartOptions& options) {
  ModelInputs inputs;
  Warnings unheard(nullptr);
  FileList files(model);
  files.add(model);
  const FileListener listener([&](const std::string& path) { files.add(path); });
  const std::optional<std::string> fault = fault_of([&] {
    whole_file(model);
    const std::unique_ptr<PartReader> parts = open_parts(model, options, unheard, listener);
    inputs.fault =
        parts ? list_parts(model, *parts, files, unheard) : list_obj(model, files, unheard);
  });
  if (fault) inputs.fault = fault;
  inputs.files = files.take();
  return inputs;
}

}  // namespace atlasgauge
