#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/answers.hpp"
#include "io/texture/texture_slots.hpp"

namespace atlasgauge {

/// A family of hostile models of any size, with what the program must say of them.
struct WorstCase {
  std::string_view name;
  std::string_view attacks;  ///< what of the program it is hard on
  std::string_view unit;     ///< what the size counts
  /// Writes `stem`.obj and what belongs to it; in constant memory.
  void (*write)(std::uint64_t size, const std::string& stem);
  Answers (*answers)(std::uint64_t size);      ///< null where there is a refusal
  std::optional<ImageSize> texture_size = {};  ///< to be given with -t
  /// Part of the message, when the model must be refused as bad input.
  std::string_view refusal = {};
};

const std::vector<WorstCase>& worst_cases();

/// By name. Throws Error(kUsage) when there is none of it.
const WorstCase& worst_case_of(std::string_view name);

/// With the name of the file that write_worst_case() makes. None for a case that is refused.
Answers worst_case_answers(const WorstCase& worst_case, std::uint64_t size);

/// Writes NAME.obj, what belongs to it and NAME.answers.json. Throws Error(kUsage) for a size that
/// the case cannot have.
void write_worst_case(const WorstCase& worst_case, std::uint64_t size,
                      const std::string& directory);

}  // namespace atlasgauge
