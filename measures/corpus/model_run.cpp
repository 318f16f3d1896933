#include "measures/corpus/model_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <string_view>

#include "io/error.hpp"
#include "io/process/data_limit.hpp"

namespace atlasgauge {
namespace {

/// What a faulty program gets from the system; all else is sent, or the fault of a disk (SIGBUS).
bool is_crash(int signal) {
  constexpr std::array kCrashes{SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGTRAP, SIGSYS};
  return std::ranges::find(kCrashes, signal) != kCrashes.end();
}

/// Paths begin a text, or after what is no part of a path.
std::string without_root(std::string text, const std::string& root) {
  const std::string prefix = root + "/";
  const auto begins_path = [&](std::size_t at) {
    return at == 0 || std::string_view(" \"'(").find(text[at - 1]) != std::string_view::npos;
  };
  for (std::size_t at = 0; (at = text.find(prefix, at)) != std::string::npos;) {
    begins_path(at) ? void(text.erase(at, prefix.size())) : void(++at);
  }
  return text;
}

/// The program's last word, as main says it.
std::string last_message(const std::string& text) {
  constexpr std::string_view kBegin = "atlasgauge: ";
  std::size_t at = text.rfind("\n" + std::string(kBegin));
  if (at != std::string::npos) ++at;
  if (at == std::string::npos && text.starts_with(kBegin)) at = 0;
  if (at == std::string::npos) return "";
  const std::string rest = text.substr(at + kBegin.size());
  return rest.substr(0, rest.find('\n'));
}

Outcome outcome_of_code(int code) {
  if (code == 0) return Outcome::kMeasured;
  return code == static_cast<int>(ErrorKind::kResource) ? Outcome::kRefused : Outcome::kFailed;
}

}  // namespace

ChildCommand measure_command(const std::string& path, const std::vector<std::string>& arguments,
                             const ModelShare& share) {
  ChildCommand command;
  command.arguments = {"/proc/self/exe", "measure",
                       "--json",         "-",
                       "--progress",     "never",
                       "--memory",       std::to_string(share.memory_bytes),
                       "--threads",      std::to_string(share.threads)};
  command.data_bytes = data_limit(share.memory_bytes, share.threads);
  auto& words = command.arguments;
  if (!share.tmp_dir.empty()) words.insert(words.end(), {"--tmp-dir", share.tmp_dir});
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.insert(words.end(), {"--", path});
  return command;
}

ModelOutcome outcome_of(const ChildEnd& end, const std::string& root) {
  if (end.signal != 0) {
    const bool crash = is_crash(end.signal);
    return {crash ? Outcome::kFailed : Outcome::kKilled,
            fmt::format("{} by signal {} ({})", crash ? "crashed" : "killed", end.signal,
                        ::strsignal(end.signal)),
            {}};
  }
  const std::string tail = end.messages.text();
  const Outcome outcome = outcome_of_code(end.exit_code);
  if (outcome == Outcome::kMeasured && end.out_cut) {
    return {Outcome::kFailed,
            fmt::format("its report is longer than {} bytes", ChildProcesses::kMostOutBytes),
            {}};
  }
  if (outcome == Outcome::kMeasured) return {outcome, "", read_warnings_line(tail)};
  const std::string message = without_root(last_message(tail), root);
  return {outcome,
          message.empty() ? fmt::format("ended with exit code {} and no message", end.exit_code)
                          : message,
          {}};
}

}  // namespace atlasgauge
