#pragma once

#include <cstddef>
#include <string>

namespace atlasgauge {

/// Names of materials and files are the only part of a model that stays in memory while it is
/// read, so there is a limit to them: 100 000 materials with an image each, in a folder with a path
/// of a hundred bytes.
class NameRoom {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{48} << 20;

  /// `path` is the file that errors blame.
  explicit NameRoom(std::string path);

  /// Counts one more name, or a pair of them. Throws Error(kResource) when there is no room.
  void add(std::size_t name_bytes);

 private:
  std::string path_;
  std::size_t names_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace atlasgauge
