#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/texture/library_names.hpp"
#include "io/texture/mtl_reader.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/temp_dir.hpp"

// Any MTL gives materials or an input error; any `mtllib` line gives names of files that exist.
namespace atlasgauge {
namespace {

/// One folder for all inputs: making one a time would take longer than reading.
const TempDir& folder() {
  static const TempDir dir;
  return dir;
}

bool has_line_end(const std::string& name) {
  return name.find('\n') != std::string::npos;
}

void read_materials(const std::string& text) {
  Warnings warnings(nullptr);
  const std::string path = folder().write("model.mtl", text);
  try {
    const std::vector<Material> materials = read_mtl(path, warnings);
    for (const Material& material : materials) {
      fuzz::require(!has_line_end(material.name), "a name lies within one line");
      if (!material.image) continue;
      fuzz::require(!material.image->empty(), "an image has a name");
      fuzz::require(!has_line_end(*material.image), "an image's name lies within one line");
      fuzz::require(material.image->find('\\') == std::string::npos, "backslashes become slashes");
    }
  } catch (const Error& error) {
    fuzz::require(error.kind() == ErrorKind::kInput, error.what());
    fuzz::require(std::string(error.what()).starts_with(path), "the error names the file");
  }
}

std::size_t count_words(const std::string& text) {
  std::size_t words = 0;
  bool in_word = false;
  for (const char c : text) {
    const bool is_blank = std::isspace(static_cast<unsigned char>(c)) != 0 && c != '\n';
    words += !is_blank && !in_word ? 1 : 0;
    in_word = !is_blank;
  }
  return words;
}

void resolve_libraries(const std::string& line, const std::set<std::string>& files) {
  std::size_t lookups = 0;
  const LibraryNames names = split_library_names(line, [&](const std::string& name) {
    ++lookups;
    return files.contains(name);
  });
  for (const std::string& name : names.found) {
    fuzz::require(files.contains(name), "found names exist");
  }
  for (const std::string& name : names.missing) {
    fuzz::require(line.find(name) != std::string::npos, "missing names are spelled as in the line");
  }
  const std::size_t words = count_words(line);
  fuzz::require(names.found.size() + names.missing.size() <= std::max<std::size_t>(1, words),
                "a name has a word or more");
  constexpr std::size_t kMostLookupsAWord = 3 * 64;
  fuzz::require(lookups <= 3 + words * kMostLookupsAWord, "look-ups are bounded by the words");
}

void read_texts(FuzzedDataProvider& input) {
  std::set<std::string> files;
  const std::string line = input.ConsumeRandomLengthString(100);
  for (int count = input.ConsumeIntegralInRange(0, 4); count > 0; --count) {
    files.insert(input.ConsumeRandomLengthString(20));
  }
  resolve_libraries(line, files);
  read_materials(input.ConsumeRemainingBytesAsString());
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  FuzzedDataProvider input(data, bytes);
  atlasgauge::read_texts(input);
  return 0;
}
