#include "bench/worst/families.hpp"
#include "bench/worst/open_fan.hpp"
#include "bench/worst/strip.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kStripFaces = 1000;
/// Bytes of blanks between two corners of the long polygon.
constexpr std::uint64_t kPaddingBytes = 1000;

/// A small strip with a long line on line 3.
void write_strip_with(const std::string& stem, auto put_line) {
  const Strip strip{.faces = kStripFaces};
  ObjFile obj(stem);
  obj.put("# line 1\n# line 2\n");
  put_line(obj);
  obj.put('\n');
  put_strip_vertices(strip, obj);
  put_strip_texcoords(strip, obj);
  put_strip_faces(strip, obj);
  obj.close();
}

template <char kByte>
void write_word(std::string_view before, std::uint64_t size, const std::string& stem,
                std::string_view after = "") {
  write_strip_with(stem, [&](ObjFile& obj) {
    obj.put(before);
    obj.put_times(kByte, size);
    obj.put(after);
  });
}

Answers strip_answers(std::uint64_t) {
  return answers_of(open_strip_shape(kStripFaces));
}

/// The first vertex of the strip, (0, 0, 0).
void write_blanks(std::uint64_t size, const std::string& stem) {
  const Strip strip{.faces = kStripFaces};
  ObjFile obj(stem);
  obj.put("v 0");
  obj.put_times(' ', size / 2);
  obj.put('0');
  obj.put_times('\t', size / 2);
  obj.put("0 # a point\n");
  for (std::uint64_t j = 1; j < strip.vertices(); ++j) obj.put_vertex(3 * j, 4 * (j % 2));
  put_strip_texcoords(strip, obj);
  put_strip_faces(strip, obj);
  obj.close();
}

std::uint64_t polygon_faces(std::uint64_t size) {
  return size / kPaddingBytes;
}

void write_polygon(std::uint64_t size, std::string_view padding, const std::string& stem) {
  const std::uint64_t faces = polygon_faces(size);
  ObjFile obj(stem);
  put_open_fan_vertices(faces, obj);
  obj.put('f');
  for (std::uint64_t i = 0; i < faces + 2; ++i) {
    obj.put(' ');
    for (std::uint64_t bytes = 0; bytes < kPaddingBytes; bytes += padding.size()) obj.put(padding);
    obj.put(i + 1);
  }
  obj.put('\n');
  obj.close();
}

Answers polygon_answers(std::uint64_t size) {
  return answers_of(open_fan_shape(polygon_faces(size)));
}

void write_library_with_long_line(std::uint64_t size, const std::string& stem) {
  TextFile mtl(stem + ".mtl");
  mtl.put("newmtl m\n# ");
  mtl.put_times('x', size);
  mtl.put('\n');
  mtl.close();
  write_strip_with(stem, [&](ObjFile& obj) { obj.put("usemtl m"); });
}

}  // namespace

std::vector<WorstCase> long_line_cases() {
  return {
      {"long_comment", "a comment as long as the file", "bytes",
       [](std::uint64_t size, const std::string& stem) { write_word<'x'>("# ", size, stem); },
       strip_answers},
      {"long_unknown", "an unknown statement as long as the file", "bytes",
       [](std::uint64_t size, const std::string& stem) { write_word<'x'>("x", size, stem); },
       strip_answers},
      {"long_polygon", "a polygon as long as the file, padded with blanks", "bytes",
       [](std::uint64_t size, const std::string& stem) { write_polygon(size, "          ", stem); },
       polygon_answers},
      {"long_continued", "a polygon over very many continued lines", "bytes",
       [](std::uint64_t size, const std::string& stem) { write_polygon(size, "\\\n", stem); },
       polygon_answers},
      {"long_library_line", "an MTL of one line", "bytes", write_library_with_long_line,
       strip_answers},
      {"long_number", "a number of very many digits", "bytes",
       [](std::uint64_t size, const std::string& stem) {
         write_word<'0'>("v 0.", size, stem, " 0 0");
       },
       nullptr, std::nullopt, ".obj:3: found a word of more than 65536 bytes"},
      {"long_material", "a material name as long as the file", "bytes",
       [](std::uint64_t size, const std::string& stem) { write_word<'x'>("usemtl ", size, stem); },
       nullptr, std::nullopt, ".obj:3: found a material name of more than 65536 bytes"},
      {"long_library", "a library name as long as the file", "bytes",
       [](std::uint64_t size, const std::string& stem) { write_word<'x'>("mtllib ", size, stem); },
       nullptr, std::nullopt, ".obj:3: found a file name of more than 65536 bytes"},
      {"long_blanks", "a vertex line padded with blanks", "bytes", write_blanks, strip_answers},
  };
}

}  // namespace atlasgauge
