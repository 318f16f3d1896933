#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "stream/mesh/triangle.hpp"

namespace atlasgauge {

// The groups that the stages make and measures add up. Levels are those of SPEC section 1.

/// A raw edge: an unordered pair of vertex indices, and the faces on it.
struct RawEdge {
  std::uint64_t faces;
  double length_3d;  ///< model units
  bool coherent;     ///< two faces, which run it in opposite directions
};

/// A uv edge: an unordered pair of (welded vertex, u, v, texture).
struct UvEdge {
  std::uint64_t faces;
  double length_texels;  ///< of its first face; 0 where that has no UV triangle
};

/// One side of a seam edge: its segment in the atlas, from the first vertex of the edge to the
/// second.
struct SeamSide {
  SlotId slot = kNone<SlotId>;
  TexCoord t[2]{};  ///< as in the file, or kNoTexCoord
};

/// A seam edge, both of its faces in charts of nonzero UV area. Its sides are in the order of slot
/// and UVs, so that nothing of it depends on the order of faces.
struct SeamEdge {
  VertexId v[2]{};  ///< welded, the lower first
  SeamSide sides[2];
  double length_3d = 0;       ///< model units
  bool sampled = false;       ///< both sides have a UV triangle within reach and a decoded image
  std::uint64_t samples = 0;  ///< n; 0 where it is not sampled, or too short
  double discrepancy = std::numeric_limits<double>::quiet_NaN();  ///< D(e); NaN where n = 0
  /// The same as TexMetro has it; NaN unless asked for.
  double texmetro_discrepancy = std::numeric_limits<double>::quiet_NaN();
};

/// A seam edge in space.
struct LocatedSeam {
  SeamEdge edge;
  Position p[2];
};

/// All seam edges, in the order of their vertices, one after the other.
class SeamRows {
 public:
  virtual ~SeamRows() = default;
  virtual std::uint64_t count() const = 0;
  /// False at the end.
  virtual bool read(LocatedSeam& seam) = 0;
};

/// The seam edges with samples that have a side on a slot.
struct TextureSeams {
  SlotId slot;
  std::uint64_t edges;
  double length_3d;    ///< of all, model units
  double discrepancy;  ///< mean of D(e) by length
};

/// A boundary edge at which two parts of a model should meet, but do not (stream/mesh/cracks.hpp).
struct CrackEdge {
  double length_3d;  ///< model units
};

/// The corners at one vertex, at the raw level.
struct VertexStar {
  std::uint64_t corners;
  std::uint64_t boundary_edges;
  bool nonmanifold_edge;  ///< some edge at it has more than two faces
  bool one_fan;           ///< its faces are joined across its edges into one fan
  std::uint64_t
      duplicate_faces;  ///< faces, of which it is the smallest vertex, that repeat another
};

/// A connected component of faces over raw edges.
struct Component {
  std::uint64_t faces;
  bool orientable;
};

/// A connected component of faces over uv edges. All its faces have one slot.
struct Chart {
  FaceId first_face;  ///< the number of the chart
  std::uint64_t faces;
  bool null;        ///< every face has UV area 0
  bool orientable;  ///< its faces can be flipped to run coherently
  std::uint64_t folds;
  SlotId slot = kNone<SlotId>;
  double area_3d = 0;            ///< model units squared; only where it was asked for
  double area_uv = 0;            ///< sum of the absolute areas of its faces, texels squared
  double perimeter = 0;          ///< of its uv boundary edges, texels; only where it was asked for
  UvBox uv_box{};                ///< of its faces with a UV triangle, UVs as in the file
  double width = 0, height = 0;  ///< of that box, in texels
};

/// What covers the texels of one mip level of a slot, or of a part of it (SPEC section 4).
struct TexelCounts {
  std::uint64_t covered = 0;           ///< texels with n > 0
  std::uint64_t drawn = 0;             ///< sum of n
  std::uint64_t bilinear = 0;          ///< with n > 0, or with such a texel among their neighbours
  std::uint64_t overwritten = 0;       ///< with n > 1
  std::uint64_t lost = 0;              ///< sum of n - 1 over those
  std::uint64_t boundary = 0;          ///< covered, with an uncovered neighbour or on the rim
  std::uint64_t clashes = 0;           ///< covered, with a neighbour that another chart covers
  std::uint64_t overlaps_between = 0;  ///< covered by two charts or more

  void merge(const TexelCounts& other) {
    covered += other.covered;
    drawn += other.drawn;
    bilinear += other.bilinear;
    overwritten += other.overwritten;
    lost += other.lost;
    boundary += other.boundary;
    clashes += other.clashes;
    overlaps_between += other.overlaps_between;
  }
};

/// One mip level of a slot, rastered.
struct TextureLevel {
  SlotId slot;
  std::uint32_t level;
  std::uint64_t width, height;  ///< texels
  TexelCounts counts;
};

/// A value with its weight, of which the exact weighted percentiles are taken.
struct Sample {
  double value;   ///< not negative
  double weight;  ///< not negative
};

/// Takes the groups of one worker. Calls to one sink come from one thread at a time.
class GroupSink {
 public:
  virtual ~GroupSink() = default;
  virtual void accept(std::span<const Triangle> triangles) = 0;
  virtual void accept(std::span<const RawEdge> edges) = 0;
  virtual void accept(std::span<const UvEdge> edges) = 0;
  virtual void accept(std::span<const SeamEdge> edges) = 0;
  virtual void accept(std::span<const VertexStar> stars) = 0;
  virtual void accept(std::span<const CrackEdge> edges) = 0;
  virtual void accept(std::span<const Component> components) = 0;
  virtual void accept(std::span<const Chart> charts) = 0;
  virtual void accept(std::span<const TextureLevel> levels) = 0;
  /// Appends the samples that a distribution takes of these groups.
  virtual void sample(std::size_t distribution, std::span<const Triangle> triangles,
                      std::vector<Sample>& samples) = 0;
  virtual void sample(std::size_t distribution, std::span<const Chart> charts,
                      std::vector<Sample>& samples) = 0;
  /// A sample beyond the cutoff of its distribution.
  virtual void cut(std::size_t distribution, const Sample& sample) = 0;
};

/// One sink a worker, and the names of the distributions they sample.
class GroupSinks {
 public:
  virtual ~GroupSinks() = default;
  virtual GroupSink& of_worker(std::size_t worker) = 0;
  virtual std::vector<std::string> distributions() const = 0;
  /// The largest value that a distribution keeps, once all other groups are handed out; infinity
  /// where it keeps all.
  virtual double cutoff(std::size_t distribution) const = 0;
};

/// Collects groups and hands them over a few hundred at a time.
template <class Group>
class GroupBuffer {
 public:
  static constexpr std::uint64_t memory_bytes() { return kGroups * sizeof(Group); }

  explicit GroupBuffer(GroupSink& sink) : sink_(&sink) { groups_.reserve(kGroups); }
  void push(const Group& group) {
    groups_.push_back(group);
    if (groups_.size() == kGroups) flush();
  }
  void flush() {
    sink_->accept(std::span<const Group>(groups_));
    groups_.clear();
  }

 private:
  static constexpr std::size_t kGroups = 256;
  GroupSink* sink_;
  std::vector<Group> groups_;
};

}  // namespace atlasgauge
