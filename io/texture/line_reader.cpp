#include "io/texture/line_reader.hpp"

#include <algorithm>

namespace atlasgauge {

LineReader::LineReader(ByteSource& source, std::size_t max_line_bytes)
    : source_(source), max_line_bytes_(max_line_bytes) {}

bool LineReader::next() {
  line_.clear();
  is_cut_ = false;
  if (unread_.empty() && !fill()) return false;
  ++number_;
  do {
    const std::size_t line_end = unread_.find('\n');
    append(unread_.substr(0, line_end));
    if (line_end != std::string_view::npos) {
      unread_.remove_prefix(line_end + 1);
      break;
    }
  } while (fill());
  constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
  if (number_ == 1 && line_.starts_with(kUtf8Mark)) line_.erase(0, kUtf8Mark.size());
  return true;
}

bool LineReader::fill() {
  unread_ = {buffer_.data(), source_.read(buffer_.data(), buffer_.size())};
  return !unread_.empty();
}

void LineReader::append(std::string_view text) {
  const std::size_t room = max_line_bytes_ - line_.size();
  is_cut_ = is_cut_ || text.size() > room;
  line_.append(text.substr(0, room));
}

}  // namespace atlasgauge
