#pragma once

#include <cstdint>

#include "io/texture/texture_slots.hpp"
#include "io/warnings.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/records.hpp"
#include "stream/seams/decode.hpp"

namespace atlasgauge {

/// What is wanted of seam edges.
struct SeamPlan {
  DecodePlan decode;
  bool texmetro = false;    ///< sample them as TexMetro does, too
  bool keep_edges = false;  ///< for a table of all
};

/// What sampling did, for those who want to see that it did.
struct SeamWork {
  std::uint64_t images_decoded = 0;
  std::uint64_t texels_decoded = 0;
  std::uint64_t sample_pairs = 0;
};

struct SeamResults {
  Spill<SeamEdge> edges;         ///< in no order; empty unless they were to be kept
  Spill<TextureSeams> textures;  ///< by slot; of those that have any
  SeamWork work;
};

/// To be called before the work of a run: see require_room_for_images. Whatever passes here finds
/// its memory later.
void require_room_for_seams(const Engine& engine, const TextureSlots& textures,
                            const DecodePlan& plan);

/// Measures the colours along seam edges (SPEC section 5), and hands the edges out. Consumes them.
///
/// The two sides of an edge may lie anywhere in any two textures, so the texels come to the edges
/// rather than the other way round:
///   1. the images that edges lie on are decoded into tiles in scratch;
///   2. every side asks for the texels around its samples, once for each footprint of 2 x 2 texels
///      that successive samples share; the requests are distributed by tile;
///   3. each tile is read once and answers its requests with the texels as stored; the answers are
///      distributed by edge;
///   4. with the answers of an edge in memory, its samples are taken and their distances added one
///      after the other;
///   5. edges so long that this would be much are followed from texel to texel instead.
/// No step depends on where tiles end, on the memory or on the number of threads.
SeamResults sample_seams(const Engine& engine, Spill<SeamCandidate> candidates,
                         const TextureSlots& textures, const SlotFrames& frames,
                         const SeamPlan& plan, Warnings& warnings, GroupSinks& sinks);

}  // namespace atlasgauge
