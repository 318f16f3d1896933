#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "stream/groups.hpp"

namespace atlasgauge {

/// What a worker's groups come to.
struct GroupCounts {
  std::uint64_t raw_edges = 0, boundary_edges = 0, uv_edges = 0;
  std::uint64_t seams = 0, sample_pairs = 0;
  double discrepancy = 0;  ///< sum over the seams with samples
};

/// Counts groups and does nothing else, so that a benchmark times what makes them.
class CountingSinks : public GroupSinks {
 public:
  explicit CountingSinks(std::size_t workers) : sinks_(workers) {}

  GroupSink& of_worker(std::size_t worker) override { return sinks_[worker]; }
  std::vector<std::string> distributions() const override { return {}; }
  double cutoff(std::size_t) const override { return std::numeric_limits<double>::infinity(); }

  GroupCounts total() const {
    GroupCounts total;
    for (const Sink& sink : sinks_) {
      total.raw_edges += sink.counts.raw_edges;
      total.boundary_edges += sink.counts.boundary_edges;
      total.uv_edges += sink.counts.uv_edges;
      total.seams += sink.counts.seams;
      total.sample_pairs += sink.counts.sample_pairs;
      total.discrepancy += sink.counts.discrepancy;
    }
    return total;
  }

 private:
  class Sink : public GroupSink {
   public:
    void accept(std::span<const RawEdge> edges) override {
      counts.raw_edges += edges.size();
      for (const RawEdge& edge : edges) counts.boundary_edges += edge.faces == 1 ? 1 : 0;
    }
    void accept(std::span<const UvEdge> edges) override { counts.uv_edges += edges.size(); }
    void accept(std::span<const SeamEdge> edges) override {
      counts.seams += edges.size();
      for (const SeamEdge& edge : edges) {
        counts.sample_pairs += edge.samples;
        if (edge.samples > 0) counts.discrepancy += edge.discrepancy;
      }
    }
    void accept(std::span<const Triangle>) override {}
    void accept(std::span<const VertexStar>) override {}
    void accept(std::span<const Component>) override {}
    void accept(std::span<const Chart>) override {}
    void accept(std::span<const CrackEdge>) override {}
    void accept(std::span<const TextureLevel>) override {}
    void sample(std::size_t, std::span<const Triangle>, std::vector<Sample>&) override {}
    void sample(std::size_t, std::span<const Chart>, std::vector<Sample>&) override {}
    void cut(std::size_t, const Sample&) override {}

    GroupCounts counts;
  };

  std::vector<Sink> sinks_;
};

}  // namespace atlasgauge
