// What percentiles cost a sample, from the taking of it.

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bench/permutation.hpp"
#include "bench/stages/bench_engine.hpp"
#include "bench/stages/job.hpp"
#include "stream/engine/quantiles.hpp"

namespace {

using namespace atlasgauge;

/// The whole numbers from 1 in random order, all of one weight.
class QuantilesJob : public Job {
 public:
  QuantilesJob(std::uint64_t samples, Room room, std::size_t threads)
      : samples_(samples), room_(room), threads_(threads), order_(samples, 1) {}

  void prepare() override {
    engine_ = std::make_unique<BenchEngine>(room_, samples_ * sizeof(Sample), threads_);
  }
  void run() override {
    SampleStore store(engine_->engine().scratch);
    SampleStore::Writer writer(store);
    for (std::uint64_t i = 0; i < samples_; ++i) {
      writer.push({1 + static_cast<double>(order_(i)), 0.25});
    }
    writer.flush();
    const auto nobody = [](std::size_t, const Sample&) {};
    found_ = select_up_to(engine_->engine(), store.finish(),
                          std::numeric_limits<double>::infinity(), nobody)
                 .all;
  }
  void check() override {
    for (std::size_t i = 0; i < Quantiles::kPercents.size(); ++i) {
      const auto percent = static_cast<std::uint64_t>(Quantiles::kPercents[i]);
      const std::uint64_t rank = (percent * samples_ + 99) / 100;
      expect(found_.rising[i] == static_cast<double>(rank), "a percentile is wrong");
      expect(found_.falling[i] == static_cast<double>(samples_ + 1 - rank),
             "a percentile from above is wrong");
    }
    expect(engine_->kept_to_its_room(), "scratch is not where it should be");
  }

 private:
  std::uint64_t samples_;
  Room room_;
  std::size_t threads_;
  Permutation order_;
  std::unique_ptr<BenchEngine> engine_;
  Quantiles found_{};
};

std::vector<NamedJob> jobs(std::uint64_t samples) {
  std::vector<NamedJob> all;
  for (const Room room : {Room::kInMemory, Room::kBeyondMemory}) {
    for (const std::size_t threads : kThreads) {
      all.push_back({"percentiles/" + name_of(room) + "/threads:" + std::to_string(threads),
                     [=] { return std::make_unique<QuantilesJob>(samples, room, threads); },
                     "sample", samples});
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  return run_subject(argc, argv, {"SAMPLES", 4'000'000, jobs});
}
