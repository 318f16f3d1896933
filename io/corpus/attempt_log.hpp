#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "io/corpus/corpus_job.hpp"
#include "io/file/descriptor.hpp"

namespace atlasgauge {

/// What is known of a model without a result.
struct Attempts {
  std::uint64_t begun = 0;
  std::string reason;  ///< why the last one that told came to nothing
};

/// Remembers which models were begun and which attempts came to nothing, so that a task that starts
/// again leaves the model that brought it down for last, and a missing result has its reason. Each
/// slice has a file, attempts/SLICE.tsv; a line is appended by one system call, and whatever cannot
/// be read of it later is passed over: it decides about order and words, never about results.
class AttemptLog {
 public:
  /// `name` of the slice, or "all". Throws Error(kResource).
  AttemptLog(const CorpusJob& job, const std::string& name);

  void began(const std::string& digest) { append("began", digest, ""); }
  void came_to_nothing(const std::string& digest, const std::string& reason) {
    append("nothing", digest, reason);
  }

 private:
  void append(const std::string& event, const std::string& digest, const std::string& text);

  std::string path_;
  Descriptor file_;
};

/// All attempts of a job, by digest.
std::map<std::string, Attempts> read_attempts(const CorpusJob& job);

}  // namespace atlasgauge
