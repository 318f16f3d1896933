#include "io/ply/ply_cursor.hpp"

#include <fmt/format.h>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// Longer ones are cut in messages.
constexpr std::size_t kShownBytes = 40;

std::string at_offset(std::uint64_t line, std::uint64_t offset) {
  return line == 0 ? fmt::format(" at byte {}", offset) : "";
}

std::string record_of(const PlyPlace& place) {
  return fmt::format("element {} {} of {}", place.element->name, place.record + 1,
                     place.element->count);
}

std::string printable(std::string_view word) {
  std::string text(word.substr(0, kShownBytes));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return word.size() > kShownBytes ? text + "..." : text;
}

}  // namespace

void refuse_ply_end(const PlyPlace& place, std::uint64_t line, std::uint64_t offset) {
  throw Error(ErrorKind::kInput, place.path, line,
              fmt::format("found the end of the file{} in {}; the file is cut short or its header "
                          "promises too many, export the model again",
                          at_offset(line, offset), record_of(place)));
}

void refuse_ply_word(const PlyPlace& place, std::uint64_t line, std::string_view word) {
  throw Error(ErrorKind::kInput, place.path, line,
              fmt::format("found \"{}\" where a number is expected in {}; mend the line or export "
                          "the model again",
                          printable(word), record_of(place)));
}

void refuse_ply_length(const PlyPlace& place, std::uint64_t line, std::uint64_t offset,
                       std::int64_t length) {
  throw Error(ErrorKind::kInput, place.path, line,
              fmt::format("found a list of length {}{} in {}; export the model again", length,
                          at_offset(line, offset), record_of(place)));
}

}  // namespace atlasgauge
