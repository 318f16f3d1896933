#include "measures/base/measure.hpp"

namespace atlasgauge {
namespace {

/// Charts, and the faces folded over in them.
struct Charts {
  static constexpr std::string_view name = "charts";

  std::uint64_t charts = 0;
  std::uint64_t null_charts = 0;
  std::uint64_t nonorientable = 0;
  std::uint64_t folds = 0;

  void accumulate(const Chart& chart) {
    ++charts;
    if (chart.null) ++null_charts;
    if (!chart.orientable) ++nonorientable;
    folds += chart.folds;
  }

  void merge(const Charts& other) {
    charts += other.charts;
    null_charts += other.null_charts;
    nonorientable += other.nonorientable;
    folds += other.folds;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(charts, null_charts, nonorientable, folds);
  }

  void finish(const MeshFacts&, Report& report) const {
    report.set("num_charts", charts);
    report.set("num_null_charts", null_charts);
    report.set("charts_nonorientable", nonorientable);
    report.set("nfolds", folds);
  }
};

const Registered<Charts> registered;

}  // namespace
}  // namespace atlasgauge
