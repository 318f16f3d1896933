#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "io/file/descriptor.hpp"
#include "io/model/image_source.hpp"

namespace atlasgauge {

/// An image under a path of its own, wherever its bytes lie: readers of images take paths. Those
/// within another file or in memory are copied to memory that looks like a file, which goes with
/// this object.
class ImageFile {
 public:
  /// Throws Error(kInput) where the bytes cannot be read.
  explicit ImageFile(const ImageSource& source);

  const std::string& path() const { return path_; }
  /// Memory that the copy takes.
  std::uint64_t copied_bytes() const { return copied_bytes_; }

 private:
  void take_range(const ImageSource& source);
  void append(const char* bytes, std::size_t size);

  Descriptor copy_;
  std::string path_;
  std::uint64_t copied_bytes_ = 0;
};

}  // namespace atlasgauge
