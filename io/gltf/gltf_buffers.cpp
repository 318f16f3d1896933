#include "io/gltf/gltf_buffers.hpp"

#include <fmt/format.h>

#include <utility>

#include "io/error.hpp"
#include "io/file/uri.hpp"

namespace atlasgauge {

GltfBuffers::GltfBuffers(const GltfModel& model, std::string path, std::filesystem::path folder,
                         std::optional<ByteRange> binary, const FileListener& files)
    : model_(model),
      path_(std::move(path)),
      folder_(std::move(folder)),
      binary_(std::move(binary)),
      files_(files) {}

ByteRange GltfBuffers::view(std::uint32_t view, const std::string& what) {
  if (view >= model_.views.size()) {
    refuse(
        fmt::format("{} names buffer view {}, but there are {}", what, view, model_.views.size()));
  }
  const GltfBufferView& found = model_.views[view];
  const ByteRange& bytes = buffer(found.buffer, fmt::format("buffer view {}", view));
  if (!bytes.holds(found.byte_offset, found.byte_length)) {
    refuse(fmt::format("{} needs {} bytes from {} on of buffer {}, which has {}", what,
                       found.byte_length, found.byte_offset, found.buffer, bytes.size));
  }
  return bytes.part(found.byte_offset, found.byte_length);
}

std::optional<std::string> GltfBuffers::meshopt_of(std::uint32_t view) const {
  if (view >= model_.views.size()) return std::nullopt;
  const GltfBufferView& found = model_.views[view];
  if (!found.meshopt_extension || found.buffer >= model_.buffers.size()) {
    return found.meshopt_extension;
  }
  const GltfBuffer& buffer = model_.buffers[found.buffer];
  const bool has_bytes =
      buffer.uri.is_given() || (is_binary_chunk(found.buffer) && !buffer.is_fallback);
  return has_bytes ? std::nullopt : found.meshopt_extension;
}

const ByteRange& GltfBuffers::buffer(std::uint32_t buffer, const std::string& what) {
  const auto known = found_.find(buffer);
  if (known != found_.end()) return known->second;
  return found_.emplace(buffer, find_buffer(buffer, what)).first->second;
}

/// As long as the document says, without padding that may follow.
ByteRange GltfBuffers::find_buffer(std::uint32_t buffer, const std::string& what) const {
  if (buffer >= model_.buffers.size()) {
    refuse(
        fmt::format("{} names buffer {}, but there are {}", what, buffer, model_.buffers.size()));
  }
  const auto& [uri, byte_length, is_fallback] = model_.buffers[buffer];
  ByteRange bytes;
  if (uri.content != nullptr) {
    bytes = {path_, 0, uri.content->size(), uri.content};
  } else if (!uri.text.empty()) {
    const auto file = file_of_uri(uri.text, folder_);
    if (!file) {
      refuse(fmt::format("buffer {} is at \"{}\", which is no file; fetch it, and name the copy",
                         buffer, shown_uri(uri.text)));
    }
    files_.tell(file->string());
    bytes = whole_file(file->string());
  } else if (is_binary_chunk(buffer)) {
    bytes = *binary_;
  } else {
    refuse(fmt::format("buffer {} names no file, and there is no binary chunk for it", buffer));
  }
  if (bytes.size < byte_length) {
    refuse(fmt::format("buffer {} should have {} bytes, but has {}: it is cut off", buffer,
                       byte_length, bytes.size));
  }
  return bytes.part(0, byte_length);
}

bool GltfBuffers::is_binary_chunk(std::uint32_t buffer) const {
  return buffer == 0 && binary_ && !model_.buffers[0].uri.is_given();
}

void GltfBuffers::refuse(const std::string& text) const {
  throw Error(ErrorKind::kInput, path_, 0, text);
}

}  // namespace atlasgauge
