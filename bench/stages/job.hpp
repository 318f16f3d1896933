#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace atlasgauge {

/// A piece of work whose answer is known, done anew for every run.
class Job {
 public:
  virtual ~Job() = default;
  virtual void prepare() = 0;  ///< before every run; not timed
  virtual void run() = 0;
  virtual void check() = 0;  ///< after a run: throws WrongAnswer
};

struct WrongAnswer : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void expect(bool right, const std::string& what) {
  if (!right) throw WrongAnswer(what);
}

struct NamedJob {
  std::string name;
  std::function<std::unique_ptr<Job>()> make;
  std::string item;     ///< what time is told per
  std::uint64_t items;  ///< of them in a run
  std::uint64_t bytes = 0;
};

/// What a program measures at a size, that of its command line.
struct Subject {
  std::string size_is;  ///< what the size counts
  std::uint64_t size;
  std::function<std::vector<NamedJob>(std::uint64_t size)> jobs;
};

/// main() of a benchmark program: PROGRAM [SIZE] [--benchmark_...]. All jobs are run and checked
/// before the first is timed. CPU is that of all threads; what is told per item is CPU, too.
int run_subject(int argc, char** argv, const Subject& subject);

}  // namespace atlasgauge
