#include "io/process/message_tail.hpp"

#include <algorithm>

namespace atlasgauge {

void MessageTail::add(std::string_view piece) {
  tail_ += piece.substr(piece.size() - std::min(piece.size(), kBytes));
  if (tail_.size() > 2 * kBytes) tail_ = text();
}

std::string MessageTail::text() const {
  return tail_.substr(tail_.size() - std::min(tail_.size(), kBytes));
}

}  // namespace atlasgauge
