// Reads an OBJ as the program does, on one thread; prints its triangles.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>

#include "io/obj/obj_reader.hpp"

namespace {

using namespace atlasgauge;

struct CountingSink : MeshSink {
  void add(const MeshBatch& batch) override { faces += batch.faces.size(); }
  std::uint64_t faces = 0;
};

std::uint64_t count_faces(const char* path) {
  constexpr std::size_t kBlockBytes = 1 << 20;
  const std::unique_ptr<ByteSource> source = open_byte_source(path);
  Warnings warnings({});
  ObjReader reader(*source, path, warnings, kBlockBytes);
  ObjBlock block;
  CountingSink sink;
  while (reader.next(block)) {
    reader.parse(block);
    reader.commit(block, sink);
  }
  reader.finish();
  return sink.faces;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    std::printf("%ju\n", std::uintmax_t{count_faces(argv[1])});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
