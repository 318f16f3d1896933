#include "io/error.hpp"

#include <cerrno>
#include <system_error>

namespace atlasgauge {
namespace {

std::string located(const std::string& path, std::uint64_t line, const std::string& text) {
  if (line == 0) return path + ": " + text;
  return path + ":" + std::to_string(line) + ": " + text;
}

}  // namespace

Error::Error(ErrorKind kind, const std::string& text) : std::runtime_error(text), kind_(kind) {}

Error::Error(ErrorKind kind, const std::string& path, std::uint64_t line, const std::string& text)
    : std::runtime_error(located(path, line, text)), kind_(kind) {}

std::string errno_text() {
  return std::generic_category().message(errno);
}

}  // namespace atlasgauge
