#pragma once

#include <concepts>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measures/base/archive.hpp"
#include "measures/base/report.hpp"
#include "stream/groups.hpp"
#include "stream/pipeline.hpp"

namespace atlasgauge {

// A measure is a value that adds up groups and ends as keys of the report:
//
//   struct Wedges {
//     static constexpr std::string_view name = "wedges";
//     std::uint64_t count = 0;
//     void accumulate(const UvEdge& edge) { count += edge.faces; }   // any of the groups, any
//     number void merge(const Wedges& other) { count += other.count; } template <class Archive>
//     void serialize(Archive& a) { a(count); } void finish(const MeshFacts& facts, Report& report)
//     const { report.set("wedges", count); }
//   };
//   const Registered<Wedges> registered;
//
// Its state does not grow with the mesh. Laws, tested for every registered measure: a fresh partial
// changes nothing, any cut into partials merged in any order gives the same report, and a partial
// saved and loaded is the same.
//
// A measure with `std::optional<Sample> sample(const Triangle&)`, or of a Chart, is a distribution:
// each sample is handed to its accumulate(const Sample&), and finish() finds the exact percentiles
// of all of them in facts.distributions under its name. With `double cutoff() const` it has those
// of the samples up to there, too; cutoff() is asked of the merged partials once all groups are
// handed out, and then cut(const Sample&) is told of every sample beyond, if the measure has one.

template <class M, class Group>
concept Accumulates = requires(M measure, const Group& group) {
  measure.accumulate(group);
};

template <class M, class Group>
concept Samples = requires(M measure, const Group& group, const Sample& sample) {
  { measure.sample(group) } -> std::same_as<std::optional<Sample>>;
  measure.accumulate(sample);
};

template <class M>
concept HasCutoff = requires(const M measure) {
  { measure.cutoff() } -> std::same_as<double>;
};

template <class M>
concept HearsOfCuts = requires(M measure, const Sample& sample) {
  measure.cut(sample);
};

/// A measure without its type: one virtual call a batch.
class AnyMeasure : public GroupSink {
 public:
  virtual std::string_view name() const = 0;
  virtual bool sampled() const = 0;
  virtual double cutoff() const = 0;
  virtual std::unique_ptr<AnyMeasure> fresh() const = 0;
  virtual void merge(const AnyMeasure& other) = 0;
  virtual void save(Saver& saver) = 0;
  virtual void load(Loader& loader) = 0;
  virtual void finish(const MeshFacts& facts, Report& report) const = 0;
};

template <class M>
class MeasureOf final : public AnyMeasure {
 public:
  std::string_view name() const override { return M::name; }
  bool sampled() const override { return Samples<M, Triangle> || Samples<M, Chart>; }
  double cutoff() const override {
    if constexpr (HasCutoff<M>) return measure_.cutoff();
    return std::numeric_limits<double>::infinity();
  }
  std::unique_ptr<AnyMeasure> fresh() const override { return std::make_unique<MeasureOf>(); }
  void merge(const AnyMeasure& other) override {
    measure_.merge(dynamic_cast<const MeasureOf&>(other).measure_);
  }
  void save(Saver& saver) override { measure_.serialize(saver); }
  void load(Loader& loader) override { measure_.serialize(loader); }
  void finish(const MeshFacts& facts, Report& report) const override {
    measure_.finish(facts, report);
  }

  void accept(std::span<const Triangle> groups) override { accumulate(groups); }
  void accept(std::span<const RawEdge> groups) override { accumulate(groups); }
  void accept(std::span<const UvEdge> groups) override { accumulate(groups); }
  void accept(std::span<const SeamEdge> groups) override { accumulate(groups); }
  void accept(std::span<const VertexStar> groups) override { accumulate(groups); }
  void accept(std::span<const CrackEdge> groups) override { accumulate(groups); }
  void accept(std::span<const Component> groups) override { accumulate(groups); }
  void accept(std::span<const Chart> groups) override { accumulate(groups); }
  void accept(std::span<const TextureLevel> groups) override { accumulate(groups); }
  void sample(std::size_t, std::span<const Triangle> groups,
              std::vector<Sample>& samples) override {
    take_samples(groups, samples);
  }
  void sample(std::size_t, std::span<const Chart> groups, std::vector<Sample>& samples) override {
    take_samples(groups, samples);
  }
  void cut(std::size_t, const Sample& sample) override {
    if constexpr (HearsOfCuts<M>) measure_.cut(sample);
  }

 private:
  template <class Group>
  void accumulate(std::span<const Group> groups) {
    if constexpr (Accumulates<M, Group>) {
      for (const Group& group : groups) measure_.accumulate(group);
    }
  }

  template <class Group>
  void take_samples(std::span<const Group> groups, std::vector<Sample>& samples) {
    if constexpr (Samples<M, Group>) {
      for (const Group& group : groups) {
        const std::optional<Sample> taken = measure_.sample(group);
        if (!taken) continue;
        measure_.accumulate(*taken);
        samples.push_back(*taken);
      }
    }
  }

  M measure_;
};

/// One fresh partial of every measure there is, by name.
std::vector<std::unique_ptr<AnyMeasure>> all_measures();

void register_measure(std::unique_ptr<AnyMeasure> prototype);

/// Adds a measure to all_measures(): define one at the end of the measure's file.
template <class M>
class Registered {
 public:
  Registered() { register_measure(std::make_unique<MeasureOf<M>>()); }
};

}  // namespace atlasgauge
