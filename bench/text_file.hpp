#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace atlasgauge {

/// Text into a file, a block at a time. Throws Error(kResource).
class TextFile {
 public:
  explicit TextFile(std::string path);

  void put(char c) { *room()++ = c; }
  void put(std::string_view text);
  void put(std::uint64_t number);
  void put_times(char c, std::uint64_t times);

  /// To be called at the end: only then is all of it known to be written.
  void close();

 private:
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 20;
  static constexpr std::size_t kLongestItemBytes = 64;

  /// Where the next item goes, with room for the longest; the caller moves it on.
  char*& room() {
    if (at_ > block_.data() + kBlockBytes - kLongestItemBytes) flush();
    return at_;
  }

  void flush();
  void check() const;

  std::string path_;
  std::ofstream file_;
  std::vector<char> block_;
  char* at_ = block_.data();
};

}  // namespace atlasgauge
