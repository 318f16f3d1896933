#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace atlasgauge {

/// What went wrong, by who can mend it. The value is the exit code of the program.
enum class ErrorKind : int {
  kUsage = 2,     ///< the command line
  kInput = 3,     ///< a file's content, or a file that cannot be read
  kResource = 4,  ///< memory, disk or scratch space
  kInternal = 5,  ///< this program
};

/// The one exception type. Thrown where a fault is detected, caught once, in main.
/// what() reads "path:line: text"; the text names what was found, what was expected, what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& text);
  /// `line` is 1-based; 0 when the fault has no line.
  Error(ErrorKind kind, const std::string& path, std::uint64_t line, const std::string& text);

  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// Text of the current errno, as in "No space left on device".
std::string errno_text();

}  // namespace atlasgauge
