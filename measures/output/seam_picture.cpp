#include "measures/output/seam_picture.hpp"

#include <cmath>

#include "measures/output/seam_color.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {
namespace {

constexpr double kNoValue = -1;

Segment segment_of(const LocatedSeam& seam) {
  const double discrepancy = seam.edge.discrepancy;
  return {{seam.p[0], seam.p[1]},
          seam_color(discrepancy),
          std::isnan(discrepancy) ? kNoValue : discrepancy};
}

}  // namespace

void SeamPicture::write(SeamRows& rows) {
  file_.begin(rows.count());
  SpillWriter<Rgb> kept(engine_.scratch);
  for (LocatedSeam seam; rows.read(seam);) {
    const Segment segment = segment_of(seam);
    file_.add_ends(segment);
    kept.push(segment.color);
  }
  Spill<Rgb> colors = kept.finish();
  SpillReader<Rgb> reader(colors, SpillReader<Rgb>::Mode::kConsume);
  for (Rgb color{}; reader.read(color);) file_.add_edge(color);
}

}  // namespace atlasgauge
