#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace atlasgauge {

/// The end of a program's messages, however many it writes: there an error says what went wrong,
/// and a run how many warnings it had.
class MessageTail {
 public:
  static constexpr std::size_t kBytes = 4096;

  /// The next piece of the text, cut anywhere.
  void add(std::string_view piece);

  std::string text() const;

 private:
  std::string tail_;  ///< up to twice what is kept, so that it is not moved for every piece
};

}  // namespace atlasgauge
