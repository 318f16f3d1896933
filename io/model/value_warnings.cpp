#include "io/model/value_warnings.hpp"

namespace atlasgauge {

ValueWarnings::ValueWarnings(const std::string& path, Warnings& warnings)
    : path_(path), warnings_(warnings) {}

void ValueWarnings::polygon_dropped(const std::string& why, std::uint64_t line) {
  add(invalid_, line, "polygon dropped: " + why);
}

void ValueWarnings::finish() {
  for (Kind* const kind : {&not_finite_, &invalid_}) {
    if (kind->counted != 0) warnings_.count(kind->name, kind->counted);
    kind->counted = 0;
  }
}

void ValueWarnings::add(Kind& kind, std::uint64_t line, const std::string& text) {
  if (kind.shown == Warnings::kShownPerKind) {
    ++kind.counted;
    return;
  }
  ++kind.shown;
  warnings_.add(kind.name, path_, line, text);
}

}  // namespace atlasgauge
