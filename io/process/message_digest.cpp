#include "io/process/message_digest.hpp"

#include <algorithm>

namespace atlasgauge {
namespace {

constexpr std::string_view kPrefix = "warning: ";

}  // namespace

void MessageDigest::add(std::string_view text) {
  add_to_tail(text);
  while (true) {
    const std::size_t end = text.find('\n');
    add_to_line(text.substr(0, end));
    if (end == std::string_view::npos) return;
    end_line();
    text.remove_prefix(end + 1);
  }
}

std::string MessageDigest::tail() const {
  return tail_.substr(tail_.size() - std::min(tail_.size(), kTailBytes));
}

void MessageDigest::add_to_tail(std::string_view text) {
  tail_ += text.substr(text.size() - std::min(text.size(), kTailBytes));
  if (tail_.size() > 2 * kTailBytes) tail_ = tail();
}

void MessageDigest::add_to_line(std::string_view piece) {
  if (line_ == Line::kMayWarn) {
    match_prefix(piece);
  } else if (line_ == Line::kWarning) {
    add_to_warning(piece);
  }
}

void MessageDigest::match_prefix(std::string_view piece) {
  const std::string_view begin = piece.substr(0, kPrefix.size() - matched_);
  if (!kPrefix.substr(matched_).starts_with(begin)) {
    line_ = Line::kOther;
    return;
  }
  matched_ += begin.size();
  if (matched_ < kPrefix.size()) return;
  begin_warning();
  add_to_warning(piece.substr(begin.size()));
}

void MessageDigest::begin_warning() {
  line_ = Line::kWarning;
  ++warnings_;
  if (warnings_ <= kMostWarnings) first_warnings_.emplace_back();
}

void MessageDigest::add_to_warning(std::string_view piece) {
  if (warnings_ > kMostWarnings) return;
  std::string& kept = first_warnings_.back();
  kept += piece.substr(0, kMostWarningBytes - kept.size());
}

void MessageDigest::end_line() {
  line_ = Line::kMayWarn;
  matched_ = 0;
}

}  // namespace atlasgauge
