#include "measures/output/estimate_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "io/bytes.hpp"

namespace atlasgauge {
namespace {

constexpr double kMinute = 60, kHour = 3600, kDay = 86400;

std::string_view time_class(double seconds) {
  if (seconds < kMinute) return "seconds";
  if (seconds < kHour) return "minutes";
  return seconds < kDay ? "hours" : "days";
}

std::string duration_of(double seconds) {
  if (seconds < 1) return "1 s";
  if (seconds < kMinute) return fmt::format("{:.0f} s", seconds);
  if (seconds < kHour) return fmt::format("{:.0f} min", seconds / kMinute);
  return fmt::format("{:.1f} h", seconds / kHour);
}

std::string count_of(double count) {
  if (count < 1e4) return fmt::format("{:.0f}", count);
  if (count < 1e6) return fmt::format("{:.0f} thousand", count * 1e-3);
  return fmt::format("{:.1f} million", count * 1e-6);
}

std::string_view source_of(const ModelGuess& guess) {
  if (guess.is_whole) return "counted";
  return guess.is_reliable ? "from a sample" : "a guess: only the beginning could be sampled";
}

}  // namespace

std::string text_of(const ModelGuess& guess, const CostEstimate& cost, const MemoryPlan& plan) {
  std::string text;
  const auto line = [&](std::string_view what, const std::string& value, const std::string& note) {
    text += fmt::format("{:<22}{:>16}  {}\n", what, value, note);
  };
  line("faces", count_of(guess.faces), std::string(source_of(guess)));
  line("vertices", count_of(guess.positions), "");
  line("texture coordinates", count_of(guess.texcoords), "");
  if (guess.images > 0) {
    line("images", count_of(static_cast<double>(guess.images)),
         fmt::format("{} of scratch when decoded",
                     format_bytes(static_cast<std::uint64_t>(guess.decoded_bytes))));
  }
  line("memory, at its peak", format_bytes(cost.resident_bytes),
       fmt::format("limit {} ({})", format_bytes(plan.limit_bytes), plan.origin));
  line("scratch, at its peak", format_bytes(cost.scratch_bytes),
       fmt::format("{} of it on disk", format_bytes(cost.scratch_file_bytes)));
  line("time", std::string(time_class(cost.wall_seconds)),
       fmt::format("about {} with {} threads, {} of CPU", duration_of(cost.wall_seconds),
                   plan.workers, duration_of(cost.cpu_seconds)));
  return text;
}

Json json_of(const ModelGuess& guess, const CostEstimate& cost, const MemoryPlan& plan) {
  const auto whole = [](double value) { return static_cast<std::uint64_t>(std::llround(value)); };
  return {{"faces", whole(guess.faces)},
          {"positions", whole(guess.positions)},
          {"texcoords", whole(guess.texcoords)},
          {"images", guess.images},
          {"decoded_bytes", whole(guess.decoded_bytes)},
          {"counted", guess.is_whole},
          {"reliable", guess.is_reliable},
          {"memory_bytes", cost.resident_bytes},
          {"memory_limit_bytes", plan.limit_bytes},
          {"scratch_bytes", cost.scratch_bytes},
          {"scratch_file_bytes", cost.scratch_file_bytes},
          {"threads", plan.workers},
          {"cpu_seconds", whole(cost.cpu_seconds)},
          {"wall_seconds", whole(cost.wall_seconds)},
          {"time_class", std::string(time_class(cost.wall_seconds))}};
}

}  // namespace atlasgauge
