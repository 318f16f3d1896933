#include "io/model/element_room.hpp"

#include <fmt/format.h>

#include "io/error.hpp"
#include "io/ids.hpp"

namespace atlasgauge {

void check_room(const std::string& path, const char* what, std::uint64_t count,
                std::uint64_t more) {
  if (more <= kMaxElements - count) return;
  throw Error(ErrorKind::kResource, path, 0,
              fmt::format("found more than {} {}, the most one model may have; split the model",
                          kMaxElements, what));
}

}  // namespace atlasgauge
