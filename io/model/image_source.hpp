#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace atlasgauge {

/// Where the bytes of an image lie: a file, a range of one, or memory.
struct ImageSource {
  std::string path;             ///< of the file; of the model for an image in memory
  std::uint64_t offset = 0;     ///< of the first byte in the file
  std::uint64_t byte_size = 0;  ///< 0: all of the file
  std::shared_ptr<const std::string> content{};  ///< the bytes themselves, or null

  bool is_whole_file() const { return byte_size == 0 && content == nullptr; }
};

/// An image as a model names it.
struct NamedImage {
  std::string name;  ///< as spelled, with slashes, or what tells an image without a name apart
  ImageSource source;
};

}  // namespace atlasgauge
