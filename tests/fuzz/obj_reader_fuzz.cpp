#include <optional>
#include <string>
#include <tuple>

#include "io/error.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/obj_text.hpp"

// Any text gives values or an input error, and the same ones however it is cut into blocks.
namespace atlasgauge {
namespace {

/// Content, or the text of the error.
struct Reading {
  std::optional<ObjContent> content;
  std::string error;
};

Reading read_in_blocks(const std::string& text, std::size_t bytes_a_read, std::size_t block_bytes) {
  TextSource source(text, bytes_a_read);
  try {
    ObjContent content = read_obj(source, block_bytes);
    content.summary.invalid_polygons += content.mesh.drop_unresolved();
    content.summary.faces = content.mesh.faces.size();
    return {std::move(content), {}};
  } catch (const Error& error) {
    fuzz::require(error.kind() == ErrorKind::kInput, error.what());
    return {std::nullopt, error.what()};
  }
}

/// NaN is not equal to itself, so values are compared as bits.
template <class T>
std::string bits(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

auto values_of(const ObjContent& content) {
  const CollectSink& mesh = content.mesh;
  const ObjSummary& summary = content.summary;
  return std::tuple(bits(mesh.positions), bits(mesh.texcoords), bits(mesh.faces),
                    summary.material_names, summary.mtllib_lines, summary.positions,
                    summary.texcoords, summary.faces, summary.invalid_polygons,
                    summary.skipped_primitives, summary.unknown_statements);
}

void compare(const Reading& whole, const Reading& cut) {
  fuzz::require(whole.error == cut.error, "'" + whole.error + "' is '" + cut.error + "'");
  if (!whole.content) return;
  fuzz::require(values_of(*whole.content) == values_of(*cut.content),
                "the values do not depend on the blocks");
}

void read_both_ways(FuzzedDataProvider& input) {
  const auto block_bytes = input.ConsumeIntegralInRange<std::size_t>(64, 400);
  const auto bytes_a_read = input.ConsumeIntegralInRange<std::size_t>(1, 100);
  const std::string text = input.ConsumeRemainingBytesAsString();
  compare(read_in_blocks(text, SIZE_MAX, 1 << 16), read_in_blocks(text, bytes_a_read, block_bytes));
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  FuzzedDataProvider input(data, bytes);
  atlasgauge::read_both_ways(input);
  return 0;
}
