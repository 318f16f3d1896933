#include "io/corpus/attempt_log.hpp"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <vector>

#include "io/error.hpp"
#include "io/file/output_target.hpp"
#include "io/tsv.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

/// A line stays short enough to be written in one piece, and to be read back.
constexpr std::size_t kMostReasonBytes = 2000;

void read_attempts(const std::string& path, std::map<std::string, Attempts>& attempts) {
  try {
    for (TsvReader line(path); line.next();) {
      if (line.size() != 3) continue;
      Attempts& of_model = attempts[line.text(1)];
      if (line.text(0) == "began") ++of_model.begun;
      if (line.text(0) == "nothing") of_model.reason = line.text(2);
    }
  } catch (const Error&) {
    return;
  }
}

}  // namespace

AttemptLog::AttemptLog(const CorpusJob& job, const std::string& name)
    : path_(job.attempts_path() + "/" + name + ".tsv"),
      file_(::open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666)) {
  if (!file_) fail_to_write(path_, errno_text());
}

void AttemptLog::append(const std::string& event, const std::string& digest,
                        const std::string& text) {
  write_all(file_.get(), path_,
            tsv_line(std::array{event, digest, text.substr(0, kMostReasonBytes)}));
}

std::map<std::string, Attempts> read_attempts(const CorpusJob& job) {
  std::map<std::string, Attempts> attempts;
  std::vector<std::string> paths;
  std::error_code fault;
  for (fs::directory_iterator entry(job.attempts_path(), fault), end; !fault && entry != end;
       entry.increment(fault)) {
    paths.push_back(entry->path().string());
  }
  std::ranges::sort(paths);
  for (const std::string& path : paths) read_attempts(path, attempts);
  return attempts;
}

}  // namespace atlasgauge
