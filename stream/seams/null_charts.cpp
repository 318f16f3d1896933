#include "stream/seams/null_charts.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace atlasgauge {
namespace {

/// The faces [begin, begin + 8 * bytes) that are in null charts, one bit each.
class NullFaces {
 public:
  NullFaces(Spill<FaceId>& faces, std::uint64_t begin, std::uint64_t bytes)
      : begin_(begin), bits_(bytes) {
    SpillReader<FaceId> reader(faces);
    FaceId face{};
    while (reader.read(face)) {
      const std::uint64_t at = raw(face) - begin_;
      if (at / 8 < bits_.size()) bits_[at / 8] |= static_cast<std::uint8_t>(1U << (at % 8));
    }
  }
  bool contains(FaceId face) const {
    const std::uint64_t at = raw(face) - begin_;  // wraps below the range, and is out of it then
    return at / 8 < bits_.size() && (bits_[at / 8] >> (at % 8) & 1) != 0;
  }

 private:
  std::uint64_t begin_;
  std::vector<std::uint8_t> bits_;
};

Spill<SeamCandidate> drop(const Engine& engine, Spill<SeamCandidate> candidates,
                          const NullFaces& null_faces) {
  SpillReader<SeamCandidate> reader(candidates, SpillReader<SeamCandidate>::Mode::kConsume);
  SpillWriter<SeamCandidate> rest(engine.scratch);
  SeamCandidate seam{};
  while (reader.read(seam)) {
    if (null_faces.contains(seam.faces[0]) || null_faces.contains(seam.faces[1])) continue;
    rest.push(seam);
  }
  return rest.finish();
}

}  // namespace

Spill<SeamCandidate> drop_null_charts(const Engine& engine, Spill<SeamCandidate> candidates,
                                      Spill<FaceId> null_faces, std::uint64_t faces) {
  if (null_faces.empty()) return candidates;
  const std::uint64_t block_bytes = engine.block_bytes();
  const Reservation memory = engine.budget.reserve_between(
      4 * block_bytes, 3 * block_bytes + faces / 8 + 1, "dropping null charts");
  const std::uint64_t bytes = memory.bytes() - 3 * block_bytes;
  for (std::uint64_t begin = 0; begin < faces; begin += 8 * bytes) {
    candidates = drop(engine, std::move(candidates), NullFaces(null_faces, begin, bytes));
  }
  return candidates;
}

}  // namespace atlasgauge
