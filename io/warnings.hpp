#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "io/warning_totals.hpp"

namespace atlasgauge {

/// Counts recoverable oddities of the input (SPEC section 1) and hands the first few of each kind
/// to a printer, so that a file with a million equal faults prints a handful of lines and a total.
/// Thread-safe. With `strict`, the first warning is thrown as an Error of kind kInput instead.
class Warnings {
 public:
  using Printer = std::function<void(const std::string& message)>;
  static constexpr std::uint64_t kShownPerKind = 5;

  explicit Warnings(Printer printer, bool strict = false);

  /// `kind` is a short fixed phrase ("unknown statement"); `line` 0 means the fault has no line.
  void add(const std::string& kind, const std::string& path, std::uint64_t line,
           const std::string& text);
  /// Counts `more` further oddities of a kind without a message each.
  void count(const std::string& kind, std::uint64_t more);

  /// Occurrences by kind.
  WarningTotals totals() const;

 private:
  Printer printer_;
  bool strict_;
  mutable std::mutex mutex_;
  WarningTotals totals_;
};

}  // namespace atlasgauge
