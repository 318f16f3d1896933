#include "measures/base/measure_set.hpp"

namespace atlasgauge {

/// Hands every group to all measures of one worker; those that do not want it ignore it.
class MeasureSet::Partials : public GroupSink {
 public:
  Partials() : measures_(all_measures()) {
    for (const auto& measure : measures_) {
      if (measure->sampled()) sampled_.push_back(measure.get());
    }
  }

  void accept(std::span<const Triangle> groups) override { hand_over(groups); }
  void accept(std::span<const RawEdge> groups) override { hand_over(groups); }
  void accept(std::span<const UvEdge> groups) override { hand_over(groups); }
  void accept(std::span<const SeamEdge> groups) override { hand_over(groups); }
  void accept(std::span<const VertexStar> groups) override { hand_over(groups); }
  void accept(std::span<const CrackEdge> groups) override { hand_over(groups); }
  void accept(std::span<const Component> groups) override { hand_over(groups); }
  void accept(std::span<const Chart> groups) override { hand_over(groups); }
  void accept(std::span<const TextureLevel> groups) override { hand_over(groups); }
  void sample(std::size_t distribution, std::span<const Triangle> triangles,
              std::vector<Sample>& samples) override {
    sampled_[distribution]->sample(distribution, triangles, samples);
  }
  void sample(std::size_t distribution, std::span<const Chart> charts,
              std::vector<Sample>& samples) override {
    sampled_[distribution]->sample(distribution, charts, samples);
  }
  void cut(std::size_t distribution, const Sample& sample) override {
    sampled_[distribution]->cut(distribution, sample);
  }

  const std::vector<AnyMeasure*>& sampled() const { return sampled_; }
  void merge(const Partials& other) {
    for (std::size_t i = 0; i < measures_.size(); ++i) measures_[i]->merge(*other.measures_[i]);
  }
  void finish(const MeshFacts& facts, Report& report) const {
    for (const auto& measure : measures_) measure->finish(facts, report);
  }

 private:
  template <class Group>
  void hand_over(std::span<const Group> groups) {
    for (const auto& measure : measures_) measure->accept(groups);
  }

  std::vector<std::unique_ptr<AnyMeasure>> measures_;
  std::vector<AnyMeasure*> sampled_;
};

MeasureSet::MeasureSet(std::size_t workers) {
  for (std::size_t i = 0; i < workers; ++i) partials_.push_back(std::make_shared<Partials>());
}

std::vector<std::string> MeasureSet::distributions() const {
  std::vector<std::string> names;
  for (const AnyMeasure* measure : partials_[0]->sampled()) names.emplace_back(measure->name());
  return names;
}

double MeasureSet::cutoff(std::size_t distribution) const {
  const std::unique_ptr<AnyMeasure> whole = partials_[0]->sampled()[distribution]->fresh();
  for (const auto& partials : partials_) whole->merge(*partials->sampled()[distribution]);
  return whole->cutoff();
}

GroupSink& MeasureSet::of_worker(std::size_t worker) {
  return *partials_[worker];
}

Report MeasureSet::finish(const MeshFacts& facts) {
  for (std::size_t i = 1; i < partials_.size(); ++i) partials_[0]->merge(*partials_[i]);
  Report report;
  partials_[0]->finish(facts, report);
  return report;
}

}  // namespace atlasgauge
