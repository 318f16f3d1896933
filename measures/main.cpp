// The program: what the command line asks for, as one flow from a model to a report. With
// stream/pipeline.cpp this is where the folders are put together; nothing else prints or exits.

#include <fcntl.h>
#include <malloc.h>
#include <sched.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "io/command_line.hpp"
#include "io/error.hpp"
#include "io/file/output_file.hpp"
#include "io/progress_bar.hpp"
#include "io/texture/image_info.hpp"
#include "io/texture/texture_slots.hpp"
#include "io/warnings.hpp"
#include "measures/base/measure_set.hpp"
#include "measures/summary.hpp"
#include "stream/engine/engine.hpp"
#include "stream/memory_plan.hpp"
#include "stream/pipeline.hpp"

namespace atlasgauge {
namespace {

std::size_t usable_cpus() {
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  if (::sched_getaffinity(0, sizeof(cpus), &cpus) != 0) return 1;
  return static_cast<std::size_t>(CPU_COUNT(&cpus));
}

/// Large buffers go back to the system when they are freed: resident memory is what the limit is
/// about, and the allocator's habit of keeping them would break it.
void return_freed_memory() {
  ::mallopt(M_MMAP_THRESHOLD, 256 << 10);
  ::mallopt(M_ARENA_MAX, 2);
}

/// A closed standard stream stays closed: no file that is opened later gets its number, to be
/// written to by mistake. Writing to it fails.
void hold_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
  }
}

/// A file that may grow no larger is an error with a message, not a signal.
void let_large_files_fail() {
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Standard error takes what it can; no run fails for it.
void remark(const char* text) {
  std::fputs(text, stderr);
}

bool shows_progress(const Options& options) {
  if (options.quiet || options.progress == ProgressMode::kNever) return false;
  return options.progress == ProgressMode::kAlways || ::isatty(STDERR_FILENO) == 1;
}

void measure(const Options& options) {
  if (options.json_path) check_writable(*options.json_path);
  const Workers workers(options.threads > 0 ? options.threads : usable_cpus());
  const MemoryPlan plan = plan_memory(
      {options.memory_bytes, options.engine_memory_bytes, options.block_bytes}, workers.count());
  MemoryBudget budget(plan.engine_bytes);
  Scratch scratch({options.tmp_dir, plan.block_bytes, plan.resident_bytes}, budget);
  ProgressBar bar(shows_progress(options));
  StageLog log(scratch, workers,
               [&](const std::string& stage, double done) { bar.update(stage, done); });
  const Engine engine{budget, scratch, workers, log};
  Warnings warnings(
      [&](const std::string& text) {
        if (!options.quiet) bar.message("warning: " + text);
      },
      options.strict);

  MeasureSet measures(workers.count());
  const auto resolve = [&](const ObjSummary& obj) {
    return resolve_textures(options.model, obj.mtllib_lines, obj.material_names,
                            options.texture_size, read_image_size, warnings);
  };
  const MeshFacts facts = stream_model(engine, options.model, warnings, resolve, measures);
  const Report report = measures.finish(facts);

  bar.clear();
  if (options.json_path) write_file(*options.json_path, report.to_json().dump(1) + "\n");
  const bool json_on_stdout = options.json_path == "-";
  if (!options.quiet) {
    const std::string summary = summary_of(facts, report);
    json_on_stdout ? remark(summary.c_str()) : write_file("-", summary);
  }
  if (options.verbose) remark(cost_of(engine, plan).c_str());
}

int run(const std::vector<std::string>& arguments) {
  const CommandLine line = parse_command_line(arguments);
  if (line.text) {
    write_file("-", *line.text);
    return 0;
  }
  measure(line.options);
  return 0;
}

/// Needs no memory, as there may be none.
int fail(ErrorKind kind, const char* text) {
  remark("atlasgauge: ");
  remark(text);
  remark("\n");
  return static_cast<int>(kind);
}

/// Tells what is being caught; returns the exit code.
int tell_caught() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return fail(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::kResource,
                "the system gives no more memory; free some, or give less with --memory");
  } catch (const std::exception& error) {
    remark("atlasgauge: internal error, please report it\n");
    return fail(ErrorKind::kInternal, error.what());
  } catch (...) {
    return fail(ErrorKind::kInternal, "internal error, please report it");
  }
}

/// For errors where none can pass: libraries allocate even in destructors.
[[noreturn]] void end_at_once() noexcept {
  const bool caught = std::current_exception() != nullptr;
  ::_exit(caught ? tell_caught() : fail(ErrorKind::kInternal, "internal error, please report it"));
}

}  // namespace
}  // namespace atlasgauge

int main(int argc, char** argv) {
  std::set_terminate(atlasgauge::end_at_once);
  try {
    atlasgauge::hold_closed_streams();
    atlasgauge::let_large_files_fail();
    atlasgauge::return_freed_memory();
    return atlasgauge::run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (...) {
    return atlasgauge::tell_caught();
  }
}
