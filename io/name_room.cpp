#include "io/name_room.hpp"

#include <fmt/format.h>

#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

NameRoom::NameRoom(std::string path) : path_(std::move(path)) {}

void NameRoom::add(std::size_t name_bytes) {
  // String objects, allocation headers, and the node of a table.
  constexpr std::size_t kBytesAroundName = 128;
  ++names_;
  bytes_ += name_bytes + kBytesAroundName;
  if (bytes_ <= kMaxBytes) return;
  throw Error(
      ErrorKind::kResource, path_, 0,
      fmt::format("found {} names of materials and files, but only {} MiB are set aside for "
                  "them; split the model",
                  names_, kMaxBytes >> 20));
}

}  // namespace atlasgauge
