#include "stream/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <unordered_set>
#include <vector>

#include "io/bytes.hpp"
#include "io/error.hpp"
#include "io/file/byte_source.hpp"
#include "io/ids.hpp"
#include "io/obj/obj_sample.hpp"
#include "io/warnings.hpp"
#include "stream/engine/labels.hpp"
#include "stream/engine/page_cache.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/face_stream.hpp"
#include "stream/mesh/mesh_store.hpp"
#include "stream/mesh/records.hpp"
#include "stream/raster/region_triangle.hpp"
#include "stream/raster/tile_size.hpp"
#include "stream/seams/decode.hpp"
#include "stream/seams/texel_lookup.hpp"

namespace atlasgauge {
namespace {

constexpr double kMiB = 1 << 20;

/// What the process holds without the engine, and what the image library adds, as measured.
constexpr double kProgramBytes = 6 * kMiB;
constexpr double kImageLibraryBytes = 100 * kMiB;
/// Of the engine's working memory, what a long run has touched at its peak, as measured: groups
/// are sorted in buckets planned two thirds full.
constexpr double kTouched = 0.8;

/// Blocks that stages have begun, and fill or not.
constexpr std::uint64_t kOpenBlocks = 8;

/// Of textures that are not images.
constexpr double kUsualTextureSide = 4096;

/// Estimates may be wrong by this factor; only what is beyond it is refused.
constexpr double kTolerance = 1.5;
/// Scratch is estimated for faces in random order; those near each other take
/// down to two fifths of it.
constexpr double kScratchTolerance = 2.5;

/// A model of whose text only the beginning is known, all of it vertices, is taken for a closed
/// surface, with twice as many faces as vertices, an eighth of the texture coordinates doubled at
/// seams, and lines of usual lengths.
constexpr double kFacesPerVertex = 2;
constexpr double kTexCoordsPerVertex = 1.125;
constexpr double kFaceLineBytes = 36;
constexpr double kTexCoordLineBytes = 22;

/// No text is denser than a polygon of one-digit corners: "f 1 2 3 4...".
constexpr double kLeastBytesPerFace = 2;
constexpr double kMostScratchPerTextByte = 120;
/// Of the compression of text, hardly ever reached.
constexpr double kMostTextPerFileByte = 40;

/// Bytes of table pages that faces name, counted anew for every part of a sample.
class PageCounter {
 public:
  void add(const FaceRecord& face) {
    for (int k = 0; k < 3; ++k) {
      positions_.insert(raw(face.v[k]) / PageLayout<Position>::kRecords);
      if (face.t[k] != kNone<TexCoordId>) {
        texcoords_.insert(raw(face.t[k]) / PageLayout<TexCoord>::kRecords);
      }
    }
  }

  double bytes() const {
    return static_cast<double>(positions_.size() * PageLayout<Position>::kBytes +
                               texcoords_.size() * PageLayout<TexCoord>::kBytes);
  }

 private:
  std::unordered_set<std::size_t> positions_, texcoords_;
};

void add_image(const TextureSlot& slot, ModelGuess& guess) {
  const double width = slot.size->width, height = slot.size->height;
  const ImageNeed need = image_need(slot, 0);
  ++guess.images;
  guess.texels += width * height;
  guess.largest_side_texels = std::max({guess.largest_side_texels, width, height});
  guess.decoded_bytes += static_cast<double>(need.scratch_bytes);
  guess.decoding_bytes = std::max(guess.decoding_bytes, static_cast<double>(need.memory_bytes));
}

/// Of all images that the materials name, used or not.
void add_images(std::span<const InputMaterials> inputs, const ImageProbe& probe,
                ModelGuess& guess) {
  Warnings unheard([](const std::string&) {});
  const TextureSlots textures = resolve_textures(inputs, std::nullopt, probe, unheard);
  for (const TextureSlot& slot : textures.slots) {
    if (slot.readable) add_image(slot, guess);
  }
}

/// One more input of the model; what a cache loads for a face is the mean of all faces.
void add_input(const ModelGuess& input, ModelGuess& all) {
  const double faces = all.faces + input.faces;
  if (faces > 0) {
    all.loaded_bytes_per_face =
        (all.loaded_bytes_per_face * all.faces + input.loaded_bytes_per_face * input.faces) / faces;
  }
  all.positions += input.positions;
  all.texcoords += input.texcoords;
  all.faces = faces;
  all.text_bytes += input.text_bytes;
  all.is_whole = all.is_whole && input.is_whole;
  all.is_reliable = all.is_reliable && input.is_reliable;
}

/// Scales what the beginning of a text held up to the whole.
void extrapolate(ModelGuess& guess, double sampled_bytes) {
  guess.is_reliable = false;
  if (guess.faces > 0) {
    const double scale = guess.text_bytes / sampled_bytes;
    guess.positions *= scale;
    guess.texcoords *= scale;
    guess.faces *= scale;
    return;
  }
  if (guess.positions == 0) return;
  const double vertex_bytes = sampled_bytes / guess.positions +
                              kTexCoordsPerVertex * kTexCoordLineBytes +
                              kFacesPerVertex * kFaceLineBytes;
  guess.positions = guess.text_bytes / vertex_bytes;
  guess.texcoords = kTexCoordsPerVertex * guess.positions;
  guess.faces = kFacesPerVertex * guess.positions;
}

/// Where charts meet, texture coordinates are doubled: about one edge for each of them lies on a
/// seam. The texels of a triangle are about half of a square of its edges, on a texture half full.
struct SeamGuess {
  explicit SeamGuess(const ModelGuess& guess)
      : edges(guess.images == 0 ? 0 : std::max(0.0, guess.texcoords - guess.positions)),
        length_texels(guess.faces > 0 ? std::sqrt(guess.texels / guess.faces) : 0) {}
  double sample_pairs() const { return edges * 5 * (length_texels + 0.5); }
  double texel_bytes() const {
    constexpr double kCrossings = 1.27;  // of columns and rows, by a texel in a random direction
    return edges * 2 * (1 + kCrossings * length_texels) * sizeof(TexelAnswer);
  }

  double edges, length_texels;
};

/// What a stage keeps in scratch, and the memory it would work with if there were enough.
struct StageNeed {
  double scratch_bytes;
  double working_bytes;
};

/// The stages that need most; the records are those of the stages' own files.
std::vector<StageNeed> stage_needs(const ModelGuess& guess, const MemoryPlan& plan,
                                   double tiles_bytes) {
  const double v = guess.positions;
  const double t = guess.texcoords;
  const double f = guess.faces;
  const double positions = v * sizeof(Position);
  const double tables = positions + t * sizeof(TexCoord);
  const double model = tables + f * sizeof(FaceRecord);
  // All at once, as with faces in random order. Where faces are near each other, most are grouped
  // before they reach scratch.
  const double half_edges = 3 * f * sizeof(HalfEdge);
  const double corners = 36 * f;
  // The smallest angle, and where there are UVs distortion and scaling.
  const double samples = f * sizeof(Sample) * (t > 0 ? 3 : 1);
  const double kept = f * (sizeof(FaceLevels) + sizeof(AtlasFace)) + samples + positions;
  const double placed = v * (sizeof(Position) + sizeof(VertexId) + 4);
  const SeamGuess seams(guess);
  const double seam_bytes = seams.edges * sizeof(SeamCandidate);
  const double rest = positions + samples + seam_bytes;
  return {
      {model + placed, 3 * placed},                                // weld: table at most half full
      {tables - positions + kept + half_edges + corners, tables},  // triangles
      {kept + half_edges + corners, 2 * half_edges},               // edges: loaded and sorted
      {kept + corners + 3 * f * sizeof(Link), 2 * corners},        // stars
      {tables + f * 8, v * 8},                                     // labels of vertices
      // Raster: faces become triangles in regions, a few of them in several.
      {rest + f * (sizeof(Label) + sizeof(AtlasFace)),
       tiles_bytes + 2 * f * sizeof(RegionTriangle)},
      {rest + guess.decoded_bytes,
       static_cast<double>(plan.workers) * guess.decoding_bytes},                   // images
      {rest + guess.decoded_bytes + seams.texel_bytes(), 2 * seams.texel_bytes()},  // seams
  };
}

/// Tiles of texels, which are drawn when the half-edges are gone.
double tile_bytes(const ModelGuess& guess, const MemoryPlan& plan) {
  if (guess.texcoords == 0) return 0;
  const double side = guess.images > 0 ? guess.largest_side_texels : kUsualTextureSide;
  const std::int64_t largest = std::min(kLargestTile, static_cast<std::int64_t>(side));
  const std::int64_t size =
      choose_tile_size(plan.engine_bytes - plan.resident_bytes, plan.workers, largest);
  return kTouched * static_cast<double>(plan.workers * worker_tiles_bytes(size));
}

/// Measured on a million faces and more, in nanoseconds: a byte of text, a vertex, a face, a face
/// whose corners must be gathered, a texel between those of PNG and JPEG, and a sample pair.
double cpu_seconds(const ModelGuess& guess) {
  constexpr double kByte = 1.0, kVertex = 100, kFace = 1700, kScatteredFace = 2500;
  constexpr double kTexel = 15, kSamplePair = 150;
  constexpr double kScatteredBytes = 600;
  const double face = guess.loaded_bytes_per_face > kScatteredBytes ? kScatteredFace : kFace;
  return 1e-9 * (kByte * guess.text_bytes + kVertex * guess.positions + face * guess.faces +
                 kTexel * guess.texels + kSamplePair * SeamGuess(guess).sample_pairs());
}

double threads_gain(std::size_t workers) {
  constexpr double kSerialShare = 0.4;  // reading order, distributions, labels
  return 1 / (kSerialShare + (1 - kSerialShare) / static_cast<double>(workers));
}

std::optional<std::uint64_t> free_space(const std::string& directory) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(directory, error);
  if (error) return std::nullopt;
  return space.available;
}

std::uint64_t least(double estimate, double tolerance) {
  return static_cast<std::uint64_t>(estimate / tolerance);
}

std::uint64_t labels_that_fit(const MemoryPlan& plan) {
  return label_capacity(plan.engine_bytes - plan.resident_bytes, plan.block_bytes);
}

/// Whether the densest texts of the files' sizes would fit.
bool fits_by_size(std::span<const std::string> inputs, const MemoryPlan& plan,
                  const std::string& directory) {
  double text_bytes = 0;
  for (const std::string& path : inputs) {
    const std::unique_ptr<ByteSource> source = open_byte_source(path);
    text_bytes +=
        static_cast<double>(source->file_bytes()) * (source->is_plain() ? 1 : kMostTextPerFileByte);
  }
  const double nodes = std::min(static_cast<double>(kMaxElements), text_bytes / kLeastBytesPerFace);
  if (nodes > static_cast<double>(labels_that_fit(plan))) return false;
  const std::optional<std::uint64_t> free_bytes = free_space(directory);
  return !free_bytes || text_bytes * kMostScratchPerTextByte <= static_cast<double>(*free_bytes);
}

InputMaterials guess_obj(const std::string& path, ModelGuess& all) {
  ModelGuess guess;
  double sampled_faces = 0;
  double loaded_bytes = 0;
  ObjSampling sampling = sample_obj(path, [&](double weight, const MeshBatch& batch) {
    guess.positions += weight * static_cast<double>(batch.positions.size());
    guess.texcoords += weight * static_cast<double>(batch.texcoords.size());
    guess.faces += weight * static_cast<double>(batch.faces.size());
    PageCounter pages;
    for (const FaceRecord& face : batch.faces) pages.add(face);
    loaded_bytes += pages.bytes();
    sampled_faces += static_cast<double>(batch.faces.size());
  });
  guess.text_bytes = sampling.text_bytes;
  guess.is_whole = sampling.coverage == ObjSampling::Coverage::kWhole;
  if (sampling.coverage == ObjSampling::Coverage::kBeginning) {
    extrapolate(guess, sampling.sampled_bytes);
  }
  if (sampled_faces > 0) guess.loaded_bytes_per_face = loaded_bytes / sampled_faces;
  add_input(guess, all);
  return {path, ObjMaterials{std::move(sampling.mtllib_lines), {}}};
}

InputMaterials guess_parts(const std::string& path, PartReader& parts, ModelGuess& all) {
  ModelGuess guess;
  guess.is_whole = true;
  while (const std::unique_ptr<MeshPart> part = parts.next()) {
    const PartCounts counts = part->counts();
    guess.positions += static_cast<double>(counts.positions);
    guess.texcoords += static_cast<double>(counts.texcoords);
    guess.faces += static_cast<double>(counts.faces);
  }
  add_input(guess, all);
  return {path, parts.materials()};
}

}  // namespace

ModelGuess guess_model(std::span<const std::string> inputs, const GuessSources& sources) {
  Warnings unheard([](const std::string&) {});
  ModelGuess guess;
  guess.is_whole = true;
  std::vector<InputMaterials> materials;
  for (const std::string& path : inputs) {
    const std::unique_ptr<PartReader> parts = sources.open_parts(path, unheard);
    materials.push_back(parts ? guess_parts(path, *parts, guess) : guess_obj(path, guess));
  }
  add_images(materials, sources.probe, guess);
  return guess;
}

CostEstimate estimate_cost(const ModelGuess& guess, const MemoryPlan& plan) {
  const auto pool = static_cast<double>(plan.resident_bytes);
  const auto working_most = kTouched * static_cast<double>(plan.engine_bytes - plan.resident_bytes);
  double scratch = 0;
  double resident = 0;
  const auto open_blocks_bytes = static_cast<double>(kOpenBlocks * plan.block_bytes);
  for (const StageNeed& need : stage_needs(guess, plan, tile_bytes(guess, plan))) {
    scratch = std::max(scratch, need.scratch_bytes);
    resident = std::max(
        resident, std::min(need.scratch_bytes, pool) + std::min(need.working_bytes, working_most));
  }
  resident += kProgramBytes + (guess.images > 0 ? kImageLibraryBytes : 0);
  CostEstimate cost;
  scratch += open_blocks_bytes;
  cost.scratch_bytes = static_cast<std::uint64_t>(scratch);
  cost.scratch_file_bytes = static_cast<std::uint64_t>(std::max(0.0, scratch - pool));
  cost.resident_bytes = static_cast<std::uint64_t>(resident);
  cost.cpu_seconds = cpu_seconds(guess);
  cost.wall_seconds = cost.cpu_seconds / threads_gain(plan.workers);
  return cost;
}

void require_resources(const ModelGuess& guess, const CostEstimate& cost, const MemoryPlan& plan,
                       const std::string& directory) {
  const std::uint64_t nodes = least(std::max(guess.faces, guess.positions), kTolerance);
  if (nodes > labels_that_fit(plan)) {
    throw Error(ErrorKind::kResource,
                fmt::format("a model of about {:.0f} million faces or vertices needs more memory "
                            "than {} with {} threads; give {} or more",
                            static_cast<double>(nodes) * 1e-6, format_bytes(plan.limit_bytes),
                            plan.workers, format_bytes(2 * plan.limit_bytes)));
  }
  const std::optional<std::uint64_t> free_bytes = free_space(directory);
  const auto file_bytes = static_cast<double>(cost.scratch_file_bytes);
  if (!free_bytes || least(file_bytes, kScratchTolerance) <= *free_bytes) return;
  throw Error(ErrorKind::kResource, directory, 0,
              fmt::format("about {} of scratch will be needed, but {} are free; free space there "
                          "or give another directory with --tmp-dir",
                          format_bytes(cost.scratch_file_bytes), format_bytes(*free_bytes)));
}

void require_resources_for(std::span<const std::string> inputs, const MemoryPlan& plan,
                           const std::string& directory, const GuessSources& sources) {
  Warnings unheard([](const std::string&) {});
  const auto is_regular = [](const std::string& path) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
  };
  const auto is_obj = [&](const std::string& path) {
    return sources.open_parts(path, unheard) == nullptr;
  };
  if (!std::ranges::all_of(inputs, is_regular)) return;
  if (std::ranges::all_of(inputs, is_obj) && fits_by_size(inputs, plan, directory)) return;
  const ModelGuess guess = guess_model(inputs, sources);
  require_resources(guess, estimate_cost(guess, plan), plan, directory);
}

}  // namespace atlasgauge
