#include "bench/stages/job.hpp"

#include <benchmark/benchmark.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

namespace atlasgauge {
namespace {

void run_and_check(const NamedJob& named) {
  const std::unique_ptr<Job> job = named.make();
  job->prepare();
  job->run();
  job->check();
}

void time(benchmark::State& state, const NamedJob& named) {
  const std::unique_ptr<Job> job = named.make();
  for (auto _ : state) {
    state.PauseTiming();
    job->prepare();
    state.ResumeTiming();
    job->run();
  }
  job->check();
  using benchmark::Counter;
  const auto items = static_cast<double>(named.items);
  state.counters["per_" + named.item] =
      Counter(items, Counter::kIsIterationInvariantRate | Counter::kInvert);
  if (named.bytes > 0) {
    state.SetBytesProcessed(static_cast<std::int64_t>(named.bytes) * state.iterations());
  }
}

std::uint64_t size_of(int argc, char** argv, const Subject& subject) {
  if (argc < 2) return subject.size;
  const std::string_view text = argv[1];
  std::uint64_t size = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), size);
  const bool is_number = fault == std::errc{} && end == text.data() + text.size();
  return is_number && argc == 2 ? size : 0;
}

int run(int argc, char** argv, const Subject& subject) {
  benchmark::Initialize(&argc, argv);
  const std::uint64_t size = size_of(argc, argv, subject);
  if (size == 0) {
    std::fprintf(stderr, "usage: %s [%s] [--benchmark_...]\n", argv[0], subject.size_is.c_str());
    return 2;
  }
  const std::vector<NamedJob> jobs = subject.jobs(size);
  for (const NamedJob& job : jobs) {
    try {
      run_and_check(job);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", job.name.c_str(), error.what());
      return 1;
    }
  }
  for (const NamedJob& job : jobs) {
    benchmark::RegisterBenchmark(job.name.c_str(),
                                 [&job](benchmark::State& state) { time(state, job); })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime();
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace

int run_subject(int argc, char** argv, const Subject& subject) {
  try {
    return run(argc, argv, subject);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace atlasgauge
