// Sorts half-edges by STXXL; prints the edges.
//
//     stxxl_sort FACES MEMORY_BYTES FOLDER

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <stxxl/sorter>

#include "bench/peers/half_edges.hpp"

namespace {

using atlasgauge::PeerHalfEdge;

struct Less {
  bool operator()(const PeerHalfEdge& a, const PeerHalfEdge& b) const { return a < b; }
  static PeerHalfEdge min_value() { return {0, 0, 0, 0}; }
  static PeerHalfEdge max_value() {
    const auto most = std::numeric_limits<std::uint32_t>::max();
    return {most, most, 0, 0};
  }
};

/// Its logs would go to the working directory.
void use_folder(const std::string& folder) {
  ::setenv("STXXLLOGFILE", (folder + "/stxxl.log").c_str(), 1);
  ::setenv("STXXLERRLOGFILE", (folder + "/stxxl.errlog").c_str(), 1);
  stxxl::disk_config disk(folder + "/stxxl.tmp", 0, "syscall autogrow unlink");
  disk.direct = stxxl::disk_config::DIRECT_TRY;
  stxxl::config::get_instance()->add_disk(disk);
}

std::uint64_t count_edges(const atlasgauge::PeerGround& ground, std::size_t memory_bytes) {
  stxxl::sorter<PeerHalfEdge, Less> sorter(Less(), memory_bytes);
  ground.for_each([&](const PeerHalfEdge& half_edge) { sorter.push(half_edge); });
  sorter.sort();
  atlasgauge::EdgeCount edges;
  for (; !sorter.empty(); ++sorter) edges.add(sorter->lo, sorter->hi);
  return edges.count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  use_folder(argv[3]);
  const atlasgauge::PeerGround ground(std::strtoull(argv[1], nullptr, 10));
  const std::uint64_t edges = count_edges(ground, std::strtoull(argv[2], nullptr, 10));
  std::printf("%ju\n", static_cast<std::uintmax_t>(edges));
}
