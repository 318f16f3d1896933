#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "stream/engine/engine.hpp"
#include "stream/engine/last_uses.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/triangle.hpp"

namespace atlasgauge {

/// Groups the corners of all faces by vertex (raw level).
class StarTable {
 public:
  struct Plan {
    std::uint64_t faces;
    std::uint64_t vertices;
    std::uint64_t memory_bytes;  ///< may be taken until settle()
  };

  /// Hands out VertexStar groups, beginning with the first add().
  StarTable(const Engine& engine, const Plan& plan, const LastUses& last_faces, GroupSinks& sinks);
  ~StarTable();

  /// Emits the corners of these triangles, and groups some that are complete; one thread a worker.
  void add(std::size_t worker, std::span<const Triangle> triangles);
  /// The first `faces` faces have been added; one thread at a time.
  void pass(std::uint64_t faces);
  /// After the last add(): groups what is in memory, and frees that.
  void settle();
  /// After settle(): groups the rest. Returns the number of vertices on boundary edges.
  std::uint64_t finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace atlasgauge
