#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "io/file/byte_range.hpp"
#include "io/file/file_listener.hpp"
#include "io/gltf/gltf_model.hpp"

namespace atlasgauge {

/// Where the buffers of a glTF lie, and its buffer views. Looks at a file when it is first asked
/// for, and keeps none open. All throw Error(kInput).
class GltfBuffers {
 public:
  /// `model` and `files` outlive this. `path` is the file of the glTF, for messages; URIs are
  /// relative to `folder`; `binary` is the BIN chunk of a GLB; `files` hears of all others.
  GltfBuffers(const GltfModel& model, std::string path, std::filesystem::path folder,
              std::optional<ByteRange> binary, const FileListener& files);

  /// The bytes of a view. `what` names it for messages: "accessor 3".
  ByteRange view(std::uint32_t view, const std::string& what);

  /// The extension that keeps a view from being read: it is compressed, and its buffer is no
  /// fallback that has bytes.
  std::optional<std::string> meshopt_of(std::uint32_t view) const;

  const std::string& path() const { return path_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  const ByteRange& buffer(std::uint32_t buffer, const std::string& what);
  ByteRange find_buffer(std::uint32_t buffer, const std::string& what) const;
  bool is_binary_chunk(std::uint32_t buffer) const;
  [[noreturn]] void refuse(const std::string& text) const;

  const GltfModel& model_;
  std::string path_;
  std::filesystem::path folder_;
  std::optional<ByteRange> binary_;
  const FileListener& files_;
  std::map<std::uint32_t, ByteRange> found_;
};

}  // namespace atlasgauge
