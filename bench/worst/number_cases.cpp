#include <array>
#include <string>
#include <string_view>

#include "bench/worst/families.hpp"
#include "bench/worst/strip.hpp"

namespace atlasgauge {
namespace {

/// Vertex indices that name nothing. Cut to 31, 32, 63 or 64 bits, most would name a vertex.
constexpr std::array<std::string_view, 22> kNoVertex{"0",
                                                     "-0",
                                                     "1073741823",
                                                     "1073741824",
                                                     "2147483647",
                                                     "2147483648",
                                                     "2147483649",
                                                     "4294967295",
                                                     "4294967296",
                                                     "4294967297",
                                                     "9223372036854775807",
                                                     "9223372036854775808",
                                                     "9223372036854775809",
                                                     "18446744073709551615",
                                                     "18446744073709551616",
                                                     "18446744073709551617",
                                                     "340282366920938463463374607431768211457",
                                                     "-2147483648",
                                                     "-4294967295",
                                                     "-9223372036854775808",
                                                     "-18446744073709551615",
                                                     "-340282366920938463463374607431768211455"};

/// A polygon with such a vertex behind every face; those as texture coordinates are no UV.
void write_huge_indices(std::uint64_t size, const std::string& stem) {
  const Strip strip{.faces = size};
  ObjFile obj(stem);
  put_strip_vertices(strip, obj);
  for (std::uint64_t i = 0; i < 3; ++i) obj.put_texcoord(i, i);
  for (std::uint64_t i = 0; i < size; ++i) {
    const std::string_view none = kNoVertex[i % kNoVertex.size()];
    obj.put('f');
    for (const std::uint64_t v : strip.face(i)) {
      obj.put(' ');
      obj.put(v + 1);
      obj.put('/');
      obj.put(none);
    }
    obj.put("\nf 1 2 ");
    obj.put(none);
    obj.put('\n');
  }
  obj.close();
}

Answers huge_indices_answers(std::uint64_t size) {
  Shape shape = unmapped_strip_shape(size);
  shape.invalid = size;
  return answers_of(shape);
}

/// Faces before all vertices, and as many that name vertices which never come.
void write_forward(std::uint64_t size, const std::string& stem) {
  const Strip strip{.faces = size};
  ObjFile obj(stem);
  for (std::uint64_t i = 0; i < size; ++i) {
    obj.put_face(strip.face(i));
    obj.put_face({i, i + 1, strip.vertices() + i});
  }
  put_strip_vertices(strip, obj);
  obj.close();
}

/// Every thousandth number has more digits than any parser keeps.
std::uint64_t zeros_of(std::uint64_t vertex) {
  return vertex % 1000 == 0 ? 1000 : 20;
}

/// The same number in one of four spellings, with `zeros` zeros and an exponent that undoes them.
void put_oddly(std::uint64_t number, std::uint64_t spelling, std::uint64_t zeros, ObjFile& obj) {
  obj.put(' ');
  const std::string digits = std::to_string(number);
  switch (spelling % 4) {
    case 0:  // 12.000
      obj.put('+');
      obj.put(digits);
      obj.put('.');
      obj.put_times('0', zeros);
      return;
    case 1:  // 12000.e-3
      obj.put(digits);
      obj.put_times('0', zeros);
      obj.put(".e-");
      obj.put(zeros);
      return;
    case 2:  // .00012E+05
      obj.put('.');
      obj.put_times('0', zeros);
      obj.put(digits);
      obj.put("E+0");
      obj.put(zeros + digits.size());
      return;
    default:  // 00012
      obj.put_times('0', zeros);
      obj.put(digits);
  }
}

/// A strip in odd spellings, and as many faces with a vertex at infinity.
void write_huge_numbers(std::uint64_t size, const std::string& stem) {
  const Strip strip{.faces = size};
  ObjFile obj(stem);
  for (std::uint64_t j = 0; j < strip.vertices(); ++j) {
    obj.put('v');
    put_oddly(3 * j, j, zeros_of(j), obj);
    put_oddly(4 * (j % 2), j / 4, zeros_of(j), obj);
    obj.put(" -1e-99999\n");
  }
  for (std::uint64_t i = 0; i < size; ++i) obj.put("v 1e999 -1e99999999999999999999 1e-999\n");
  for (std::uint64_t j = 0; j < strip.vertices(); ++j) {
    obj.put("vt");
    put_oddly(j, j, zeros_of(j), obj);
    put_oddly(j % 2, j / 4, zeros_of(j), obj);
    obj.put('\n');
  }
  put_strip_faces(strip, obj);
  for (std::uint64_t i = 0; i < size; ++i) obj.put_face({i, i + 1, strip.vertices() + i});
  obj.close();
}

/// Faces with a vertex at infinity are no use of their vertices. All those vertices are equal.
Answers huge_numbers_answers(std::uint64_t size) {
  Shape shape = open_strip_shape(size);
  shape.faces += size;
  shape.nonfinite = size;
  shape.positions += size;
  shape.unreferenced = size;
  shape.coincident = size - 1;
  return answers_of(shape);
}

}  // namespace

std::vector<WorstCase> number_cases() {
  return {
      {"huge_indices", "indices beyond every integer type", "faces", write_huge_indices,
       huge_indices_answers},
      {"forward", "faces before all vertices, half of them invalid", "faces", write_forward,
       huge_indices_answers},
      {"huge_numbers", "numbers of many digits and beyond every exponent", "faces",
       write_huge_numbers, huge_numbers_answers},
  };
}

}  // namespace atlasgauge
