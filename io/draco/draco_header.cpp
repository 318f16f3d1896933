#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "io/draco/draco_mesh.hpp"
#include "io/draco/draco_need.hpp"
#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr std::string_view kMagic = "DRACO";
constexpr std::uint32_t kMetadataFlag = 0x8000;
enum EncoderType : std::uint8_t { kPointCloud = 0, kMesh = 1 };
enum EncoderMethod : std::uint8_t { kSequential = 0, kEdgebreaker = 1 };

/// Thrown by DracoBytes at the end of what there is; never leaves this file.
struct RanOut {};

/// Numbers of a stream from front to back.
class DracoBytes {
 public:
  explicit DracoBytes(std::string_view bytes) : rest_(bytes) {}

  std::string_view take(std::uint64_t bytes) {
    if (bytes > rest_.size()) throw RanOut{};
    const std::string_view taken = rest_.substr(0, bytes);
    rest_.remove_prefix(bytes);
    return taken;
  }

  /// Little-endian, of `bytes` bytes.
  std::uint32_t fixed(std::uint64_t bytes) {
    std::uint32_t value = 0;
    std::uint32_t shift = 0;
    for (const char byte : take(bytes)) {
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(byte)) << shift;
      shift += 8;
    }
    return value;
  }

  std::uint64_t left() const { return rest_.size(); }

  std::uint8_t byte() { return static_cast<std::uint8_t>(fixed(1)); }

  /// Seven bits a byte, lowest first. Bits beyond the 32nd are lost, as in Draco itself.
  std::uint32_t varint() {
    std::uint64_t value = 0;
    for (std::uint32_t shift = 0;; shift += 7) {
      const std::uint64_t next = byte();
      if (shift < 35) value |= (next & 0x7F) << shift;
      if (next < 0x80) return static_cast<std::uint32_t>(value);
    }
  }

 private:
  std::string_view rest_;
};

/// Reads the header; holds what its steps share.
class HeaderParser {
 public:
  HeaderParser(std::string_view begin, std::uint64_t stream_bytes, const std::string& path)
      : bytes_(begin), stream_bytes_(stream_bytes), path_(path) {}

  DracoHeader parse() {
    read_start();
    if (header_.has_metadata) skip_geometry_metadata();
    if (!header_.is_mesh) {
      header_.counts.positions = bytes_.fixed(4);
    } else if (header_.is_edgebreaker) {
      read_edgebreaker_counts();
    } else {
      read_sequential_counts();
    }
    return header_;
  }

 private:
  bool is_at_least(std::uint8_t major, std::uint8_t minor) const {
    return std::pair(header_.major_version, header_.minor_version) >= std::pair(major, minor);
  }

  [[noreturn]] void refuse(const std::string& text) const {
    throw Error(ErrorKind::kInput, path_, 0, text);
  }

  void read_start() {
    if (bytes_.take(kMagic.size()) != kMagic) {
      refuse("found no Draco stream: it must begin with \"DRACO\"; give a .drc file");
    }
    header_.major_version = bytes_.byte();
    header_.minor_version = bytes_.byte();
    const std::uint8_t type = bytes_.byte();
    const std::uint8_t method = bytes_.byte();
    if (type > kMesh || method > kEdgebreaker) {
      refuse(
          fmt::format("found Draco encoder type {} and method {}, expected 0 or 1 for each; the "
                      "file is damaged, write it anew",
                      type, method));
    }
    header_.is_mesh = type == kMesh;
    header_.is_edgebreaker = header_.is_mesh && method == kEdgebreaker;
    check_version();
    header_.has_metadata = (bytes_.fixed(2) & kMetadataFlag) != 0 && is_at_least(1, 3);
  }

  void check_version() const {
    const std::uint8_t last_minor = header_.is_mesh ? 2 : 3;
    const bool known = header_.major_version == 1 ||
                       (header_.major_version == 2 && header_.minor_version <= last_minor);
    if (known) return;
    refuse(
        fmt::format("found Draco bitstream version {}.{}, expected 1.0 to 2.{}; encode the model "
                    "with Draco 1.5 or older",
                    header_.major_version, header_.minor_version, last_minor));
  }

  void skip_geometry_metadata() {
    const std::uint64_t left_before = bytes_.left();
    for (std::uint32_t attributes = bytes_.varint(); attributes > 0; --attributes) {
      bytes_.varint();
      skip_metadata();
    }
    skip_metadata();
    metadata_bytes_ = left_before - bytes_.left();
  }

  /// Each node is: entries, number of nodes below it, these nodes with a name each. So nodes come
  /// one after the other, however they nest.
  void skip_metadata() {
    std::uint64_t nodes = skip_node();
    for (; nodes > 0; --nodes) {
      skip_name();
      nodes += skip_node();
    }
  }

  std::uint32_t skip_node() {
    for (std::uint32_t entries = bytes_.varint(); entries > 0; --entries) {
      skip_name();
      take_of_stream(bytes_.varint());
    }
    return bytes_.varint();
  }

  void skip_name() { bytes_.take(bytes_.byte()); }

  void take_of_stream(std::uint64_t bytes) {
    if (bytes > stream_bytes_) refuse_short();
    bytes_.take(bytes);
  }

  void read_sequential_counts() {
    const bool is_varint = is_at_least(2, 2);
    header_.counts.faces = is_varint ? bytes_.varint() : bytes_.fixed(4);
    header_.counts.positions = is_varint ? bytes_.varint() : bytes_.fixed(4);
    header_.counts.texcoords = header_.counts.positions;
    check_counts();
    set_need(draco_need::sequential(header_.counts));
  }

  void read_edgebreaker_counts() {
    const bool is_varint = is_at_least(2, 0);
    const auto number = [&] { return is_varint ? bytes_.varint() : bytes_.fixed(4); };
    bytes_.byte();                           // traversal type
    if (!is_at_least(2, 2)) (void)number();  // vertices made for seams
    header_.counts.positions = number();
    header_.counts.faces = number();
    header_.counts.texcoords = header_.counts.positions;
    header_.seamed_attributes = bytes_.byte();
    const std::uint32_t symbols = number();
    const std::uint32_t splits = number();
    check_counts();
    if (symbols > header_.counts.faces || splits > symbols) refuse_counts();
    set_need(
        header_.seamed_attributes == 0
            ? draco_need::edgebreaker(header_.counts, splits)
            : draco_need::seamed_edgebreaker(header_.counts, splits, header_.seamed_attributes));
  }

  void set_need(const draco_need::Need& need) {
    header_.attribute_bytes = need.attribute_bytes;
    header_.decoding_bytes = need.connectivity_bytes + need.attribute_bytes +
                             metadata_bytes_ * draco_need::kBytesPerMetadataByte;
  }

  void check_counts() const {
    const auto& [positions, texcoords, faces] = header_.counts;
    const std::uint64_t most_faces = stream_bytes_ * draco_need::kMostFacesPerByte;
    if (faces > most_faces || positions > 3 * most_faces) refuse_counts();
    if (faces <= kMaxElements && positions <= kMaxElements) return;
    throw Error(ErrorKind::kResource, path_, 0,
                fmt::format("found {} faces and {} points, and {} is the most one model may have; "
                            "split the model",
                            faces, positions, kMaxElements));
  }

  [[noreturn]] void refuse_counts() const {
    refuse(
        fmt::format("found {} faces and {} points in a Draco stream of {} bytes, which cannot "
                    "hold so many; the file is damaged, write it anew",
                    header_.counts.faces, header_.counts.positions, stream_bytes_));
  }

 public:
  [[noreturn]] void refuse_short() const {
    refuse(
        fmt::format("found a Draco stream of {} bytes, which ends within its header; the file "
                    "is cut short, write it anew",
                    stream_bytes_));
  }

  /// What is known when more of the stream is needed.
  DracoHeader parsed_so_far() const { return header_; }

 private:
  DracoBytes bytes_;
  std::uint64_t stream_bytes_;
  const std::string& path_;
  DracoHeader header_;
  std::uint64_t metadata_bytes_ = 0;
};

}  // namespace

DracoHeader read_draco_header(std::string_view begin, std::uint64_t stream_bytes,
                              const std::string& path) {
  HeaderParser parser(begin, stream_bytes, path);
  try {
    return parser.parse();
  } catch (const RanOut&) {
    if (begin.size() >= stream_bytes) parser.refuse_short();
  }
  DracoHeader header = parser.parsed_so_far();
  header.counts = {};
  header.decoding_bytes = stream_bytes * draco_need::kUsualBytesPerStreamByte;
  header.begin_bytes_needed = std::min<std::uint64_t>(stream_bytes, 4 * begin.size() + 256);
  return header;
}

void require_draco_mesh(const DracoHeader& header, const std::string& path) {
  if (header.is_mesh) return;
  throw Error(ErrorKind::kInput, path, 0,
              fmt::format("found a Draco point cloud of {} points, expected a mesh: there are no "
                          "faces to measure; give the mesh made from it",
                          header.counts.positions));
}

}  // namespace atlasgauge
