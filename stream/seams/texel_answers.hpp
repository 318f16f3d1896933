#pragma once

#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/seams/texel_lookup.hpp"
#include "stream/seams/texel_store.hpp"

namespace atlasgauge {

/// Reads every tile that was asked for once, and distributes the answers by seam edge, of which
/// there are `edges`.
KeyedGroups<TexelAnswer>::Buckets answer_requests(const Engine& engine, const TexelStore& store,
                                                  KeyedGroups<TexelRequest>::Buckets requests,
                                                  std::uint64_t edges);

}  // namespace atlasgauge
