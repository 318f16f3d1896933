#pragma once

#include <cstddef>
#include <cstdint>

namespace atlasgauge {

/// The private writable memory (see RLIMIT_DATA in setrlimit(2)) that a run of this program never
/// passes, whose limit of resident memory is `memory_bytes`; 0, no limit, in a build with
/// sanitizers. More than the run may use: the system counts whole stacks, of the run's threads and
/// of those that the image library starts for every CPU of the machine, and what is not touched.
std::uint64_t data_limit(std::uint64_t memory_bytes, std::size_t threads);

}  // namespace atlasgauge
