// Reads an OBJ by tinyobjloader; prints its triangles.

#include <tiny_obj_loader.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, argv[1], nullptr,
                        true)) {
    std::fprintf(stderr, "%s\n", error.c_str());
    return 1;
  }
  std::uintmax_t faces = 0;
  for (const tinyobj::shape_t& shape : shapes) faces += shape.mesh.num_face_vertices.size();
  std::printf("%ju\n", faces);
}
