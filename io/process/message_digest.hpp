#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace atlasgauge {

/// What is kept of a program's messages, however many it writes: how many warnings there were, the
/// first of them, and the end of the text, where an error says what went wrong.
class MessageDigest {
 public:
  static constexpr std::size_t kMostWarnings = 20;
  static constexpr std::size_t kMostWarningBytes = 1024;  ///< of each; the rest is cut
  static constexpr std::size_t kTailBytes = 4096;

  /// The next piece of the text, cut anywhere.
  void add(std::string_view text);

  /// Lines that begin with "warning: ".
  std::uint64_t warnings() const { return warnings_; }
  /// The first of them, without those words.
  const std::vector<std::string>& first_warnings() const { return first_warnings_; }
  /// The last bytes of all text.
  std::string tail() const;

 private:
  enum class Line { kMayWarn, kWarning, kOther };

  void add_to_tail(std::string_view text);
  void add_to_line(std::string_view piece);
  void match_prefix(std::string_view piece);
  void begin_warning();
  void add_to_warning(std::string_view piece);
  void end_line();

  Line line_ = Line::kMayWarn;
  std::size_t matched_ = 0;  ///< bytes of the prefix that the line has, while it may be a warning
  std::uint64_t warnings_ = 0;
  std::vector<std::string> first_warnings_;
  std::string tail_;  ///< up to twice what is kept, so that it is not moved for every piece
};

}  // namespace atlasgauge
