#include "io/tiles/tile_content.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "io/error.hpp"
#include "io/file/little_endian.hpp"
#include "io/json/json_view.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kB3dmHeaderBytes = 28;
constexpr std::uint64_t kCompositeHeaderBytes = 16;

/// Of the tables of a Batched 3D Model, in the order in which they lie behind its header.
struct B3dmTables {
  std::uint64_t header_bytes = kB3dmHeaderBytes;
  std::uint64_t feature_json_bytes = 0;
  std::uint64_t feature_binary_bytes = 0;
  std::uint64_t batch_json_bytes = 0;
  std::uint64_t batch_binary_bytes = 0;
};

[[noreturn]] void refuse(const ByteRange& range, const std::string& text) {
  throw Error(ErrorKind::kInput, range.path, 0, text);
}

/// The tile without what follows it: every tile's header begins with magic, version, byteLength.
ByteRange trimmed_tile(const ByteRange& range, std::uint64_t header_bytes) {
  const std::string begin = read_begin(range, 12);
  if (range.size < header_bytes) {
    refuse(range, fmt::format("found {} bytes of a tile whose header has {}: it is cut off",
                              range.size, header_bytes));
  }
  const auto version = read_number<std::uint32_t>(&begin[4]);
  if (version != 1) {
    refuse(range,
           fmt::format("found a tile ({}) of version {}, expected 1", begin.substr(0, 4), version));
  }
  const auto bytes = read_number<std::uint32_t>(&begin[8]);
  if (bytes < header_bytes || bytes > range.size) {
    refuse(range, fmt::format("its header promises {} bytes, but {} are there: it is cut off",
                              bytes, range.size));
  }
  return range.part(0, bytes);
}

/// In the older headers, what is read here as a length is the beginning of a text ('"' or "glTF"),
/// which makes it larger than any tile.
B3dmTables read_tables(const ByteRange& tile) {
  constexpr std::uint32_t kLeastText = 0x22000000;
  const std::string header = read_begin(tile, kB3dmHeaderBytes);
  const auto field = [&](std::size_t at) { return read_number<std::uint32_t>(&header[at]); };
  // Header of 20 bytes: batchLength, batchTableByteLength.
  if (field(20) >= kLeastText) return {20, 0, 0, field(16), 0};
  // Header of 24 bytes: batchTableJSONByteLength, batchTableBinaryByteLength, batchLength.
  if (field(24) >= kLeastText) return {24, 0, 0, field(12), field(16)};
  return {kB3dmHeaderBytes, field(12), field(16), field(20), field(24)};
}

bool is_feature_member(std::string_view key) {
  return key == "RTC_CENTER" || key == "byteOffset";
}

Affine center_in_binary(const ByteRange& binary, std::uint64_t offset) {
  constexpr std::uint64_t kCenterBytes = 3 * sizeof(float);
  if (!binary.holds(offset, kCenterBytes)) {
    refuse(binary, fmt::format("RTC_CENTER lies at byte {} of the feature table, which has {}",
                               offset, binary.size));
  }
  const std::string bytes = read_range(binary.part(offset, kCenterBytes));
  const auto coordinate = [&](std::size_t axis) {
    return static_cast<double>(read_number<float>(&bytes[axis * sizeof(float)]));
  };
  return Affine::translation(coordinate(0), coordinate(1), coordinate(2));
}

/// "the feature table is padded with spaces"; a tile may have none.
Affine read_center(const ByteRange& json_text, const ByteRange& binary, const JsonLimits& limits) {
  if (json_text.size == 0) return {};
  const nlohmann::json json = read_json(json_text, limits, is_feature_member);
  const std::optional<JsonView> center = JsonView(json, json_text.path).find("RTC_CENTER");
  if (!center) return {};
  if (center->is_object()) return center_in_binary(binary, center->at("byteOffset").whole());
  const std::vector<double> numbers = center->numbers(3);
  return Affine::translation(numbers[0], numbers[1], numbers[2]);
}

/// The tiles within a composite, by their own lengths.
std::vector<ByteRange> inner_tiles(const ByteRange& range) {
  const ByteRange composite = trimmed_tile(range, kCompositeHeaderBytes);
  const std::string header = read_begin(composite, kCompositeHeaderBytes);
  const auto count = read_number<std::uint32_t>(&header[12]);
  std::vector<ByteRange> tiles;
  std::uint64_t next = kCompositeHeaderBytes;
  for (std::uint32_t i = 0; i < count; ++i) {
    constexpr std::uint64_t kLeastBytes = 12;
    if (!composite.holds(next, kLeastBytes)) {
      refuse(range, fmt::format("a composite of {} tiles ends after {}", count, i));
    }
    const ByteRange rest = composite.part(next, composite.size - next);
    tiles.push_back(trimmed_tile(rest, kLeastBytes));
    next += tiles.back().size;
  }
  return tiles;
}

[[noreturn]] void refuse_unknown(const ByteRange& range, std::string_view magic) {
  if (magic.starts_with("\x1F\x8B")) {
    refuse(range, "found a tile compressed by gzip, as servers keep them; unpack it");
  }
  const bool is_text = !magic.empty() && std::isspace(static_cast<unsigned char>(magic[0])) == 0 &&
                       std::isprint(static_cast<unsigned char>(magic[0])) != 0;
  refuse(range, fmt::format("found {}, expected a tile: b3dm, cmpt or glTF",
                            is_text ? fmt::format("a file beginning with '{}'", magic.front())
                                    : std::string("no tile that is known here")));
}

}  // namespace

bool is_b3dm(const ByteRange& range) {
  return read_begin(range, 4) == "b3dm";
}

TileGltf find_in_b3dm(const ByteRange& range, const JsonLimits& limits) {
  const ByteRange tile = trimmed_tile(range, kB3dmHeaderBytes);
  const B3dmTables tables = read_tables(tile);
  const std::uint64_t features = tables.header_bytes;
  const std::uint64_t binary = features + tables.feature_json_bytes;
  const std::uint64_t batches = binary + tables.feature_binary_bytes;
  const std::uint64_t gltf = batches + tables.batch_json_bytes + tables.batch_binary_bytes;
  if (gltf >= tile.size) {
    refuse(range, fmt::format("the tables of the tile end at byte {} of {}, where its glTF should "
                              "begin: it is cut off",
                              gltf, tile.size));
  }
  return {tile.part(gltf, tile.size - gltf),
          read_center(tile.part(features, tables.feature_json_bytes),
                      tile.part(binary, tables.feature_binary_bytes), limits)};
}

std::vector<TileGltf> find_in_tile(const ByteRange& range, const JsonLimits& limits,
                                   Warnings& warnings) {
  std::vector<TileGltf> found;
  std::vector<ByteRange> open{range};
  while (!open.empty()) {
    const ByteRange tile = std::move(open.back());
    open.pop_back();
    const std::string magic = read_begin(tile, 4);
    if (magic == "b3dm") {
      found.push_back(find_in_b3dm(tile, limits));
    } else if (magic == "glTF" || magic.starts_with('{')) {
      found.push_back({tile, {}});
    } else if (magic == "cmpt") {
      const std::vector<ByteRange> tiles = inner_tiles(tile);
      open.insert(open.end(), tiles.rbegin(), tiles.rend());
    } else if (magic == "pnts" || magic == "i3dm") {
      warnings.add("tiles skipped", range.path, 0,
                   magic == "pnts" ? "a tile of points (pnts) has no surface to measure"
                                   : "a tile of instances (i3dm) is not read here");
    } else {
      refuse_unknown(tile, magic);
    }
  }
  return found;
}

}  // namespace atlasgauge
