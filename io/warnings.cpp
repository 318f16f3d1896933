#include "io/warnings.hpp"

#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

Warnings::Warnings(Printer printer, bool strict) : printer_(std::move(printer)), strict_(strict) {}

void Warnings::add(const std::string& kind, const std::string& path, std::uint64_t line,
                   const std::string& text) {
  const Error message(ErrorKind::kInput, path, line, text);
  if (strict_) throw message;
  const std::lock_guard lock(mutex_);
  const std::uint64_t seen = ++totals_[kind];
  if (seen > kShownPerKind || !printer_) return;
  printer_(message.what());
  if (seen == kShownPerKind) printer_("further warnings of this kind are counted only: " + kind);
}

void Warnings::count(const std::string& kind, std::uint64_t more) {
  const std::lock_guard lock(mutex_);
  totals_[kind] += more;
}

WarningTotals Warnings::totals() const {
  const std::lock_guard lock(mutex_);
  return totals_;
}

}  // namespace atlasgauge
