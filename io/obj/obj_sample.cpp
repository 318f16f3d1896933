#include "io/obj/obj_sample.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <system_error>

#include "io/error.hpp"
#include "io/file/byte_source.hpp"
#include "io/obj/obj_block.hpp"
#include "io/obj/obj_block_cutter.hpp"
#include "io/obj/obj_block_parser.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kMostLibraries = 100;
/// Where negative indices of a part count back from.
constexpr std::uint32_t kRelativeBase = 1U << 29;

class Sampler {
 public:
  Sampler(const std::string& path, const OnObjSample& on_sample, const ObjSampleSize& size)
      : path_(path), on_sample_(on_sample), size_(size) {}

  ObjSampling run() {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path_, error);
    if (std::filesystem::is_fifo(status) || std::filesystem::is_character_file(status)) {
      throw Error(ErrorKind::kInput, path_, 0,
                  "found a pipe, which can be read only once; give a file to estimate from");
    }
    const std::unique_ptr<ByteSource> source = open_byte_source(path_);
    const std::uint64_t file_bytes = source->file_bytes();
    if (source->is_plain() && file_bytes > size_.most_bytes) {
      sample_spread(file_bytes);
    } else {
      sample_beginning(*source);
    }
    return sampling_;
  }

 private:
  void sample_spread(std::uint64_t file_bytes) {
    sampling_.coverage = ObjSampling::Coverage::kSpread;
    sampling_.text_bytes = static_cast<double>(file_bytes);
    const std::uint64_t parts = size_.most_bytes / size_.part_bytes;
    for (std::uint64_t part = 0; part < parts; ++part) {
      const std::uint64_t offset = file_bytes / parts * part;
      if (!read_lines_at(offset)) continue;
      const auto lines_bytes = static_cast<double>(block_.text.size());
      sampling_.sampled_bytes += lines_bytes;
      parse_all(static_cast<double>(file_bytes) / static_cast<double>(parts) / lines_bytes);
    }
  }

  /// The whole lines in the part from `offset` on; false if there are none.
  bool read_lines_at(std::uint64_t offset) {
    block_.allocate(size_.part_bytes);
    char* const text = block_.text.data();
    const std::size_t bytes = read_file_at(path_, offset, text, size_.part_bytes);
    const std::string_view part(text, bytes);
    const std::size_t begin = offset == 0 ? 0 : part.find('\n') + 1;
    const std::size_t end = part.rfind('\n') + 1;
    if (end <= begin) return false;
    std::ranges::copy(part.substr(begin, end - begin), text);
    block_.text.resize(end - begin);
    return true;
  }

  void sample_beginning(ByteSource& source) {
    ObjBlockCutter cutter(source, path_, size_.part_bytes);
    bool at_end = false;
    while (sampling_.sampled_bytes < static_cast<double>(size_.most_bytes)) {
      at_end = !cutter.next(block_);
      if (at_end) break;
      sampling_.sampled_bytes += static_cast<double>(block_.text.size());
      if (block_.kind == ObjBlock::Kind::kWholeLines) parse_all(1);
    }
    sampling_.coverage = at_end ? ObjSampling::Coverage::kWhole : ObjSampling::Coverage::kBeginning;
    sampling_.text_bytes = sampling_.sampled_bytes;
    if (at_end || source.consumed_bytes() == 0) return;
    sampling_.text_bytes *=
        static_cast<double>(source.file_bytes()) / static_cast<double>(source.consumed_bytes());
  }

  void parse_all(double weight) {
    splice_lines(block_);
    while (block_.parsed_bytes < block_.text.size()) {
      const std::size_t before = block_.parsed_bytes;
      block_.clear_values();
      parse_lines(block_);
      hand_out(weight);
      if (block_.fault || block_.parsed_bytes == before) return;
    }
  }

  void hand_out(double weight) {
    for (FaceRecord& face : std::span(block_.faces.data(), block_.faces.size())) place(face);
    for (const ObjBlock::Name& library : block_.libraries.items()) {
      if (sampling_.mtllib_lines.size() == kMostLibraries) break;
      sampling_.mtllib_lines.emplace_back(block_.text_of(library));
    }
    on_sample_(weight, {.positions = block_.positions.items(),
                        .texcoords = block_.texcoords.items(),
                        .faces = block_.faces.items()});
  }

  static void place(FaceRecord& face) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t marks = raw(face.material);
      if ((marks & ObjBlock::kRelativeVertex << k) != 0) {
        face.v[k] = VertexId{raw(face.v[k]) + kRelativeBase};
      }
      if ((marks & ObjBlock::kRelativeTexCoord << k) != 0) {
        face.t[k] = TexCoordId{raw(face.t[k]) + kRelativeBase};
      }
    }
    face.material = kNone<MaterialId>;
  }

  const std::string& path_;
  const OnObjSample& on_sample_;
  ObjSampleSize size_;
  ObjBlock block_;
  ObjSampling sampling_;
};

}  // namespace

ObjSampling sample_obj(const std::string& path, const OnObjSample& on_sample,
                       const ObjSampleSize& size) {
  return Sampler(path, on_sample, size).run();
}

}  // namespace atlasgauge
