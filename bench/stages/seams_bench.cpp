// What sampling the two sides of seams costs a pair of samples: seams between random places of
// random textures, whose images come from memory.

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/seam_scene.hpp"
#include "bench/stages/bench_engine.hpp"
#include "bench/stages/group_counts.hpp"
#include "bench/stages/job.hpp"
#include "stream/seams/seam_sampling.hpp"

namespace {

using namespace atlasgauge;

/// An image of one colour.
class ColourRows : public ImageRows {
 public:
  ColourRows(ImageSize size, const std::array<std::uint8_t, 3>& colour)
      : header_{.size = size}, colour_(colour) {}

  const ImageHeader& header() const override { return header_; }
  void read(std::uint32_t rows, std::byte* to) override {
    for (std::uint64_t i = std::uint64_t{rows} * header_.size.width; i > 0; --i) {
      for (const std::uint8_t channel : colour_) *to++ = std::byte{channel};
    }
  }

 private:
  ImageHeader header_;
  std::array<std::uint8_t, 3> colour_;
};

ImageSize size_of(const SeamScene& scene) {
  return {scene.options().texture_size_texels, scene.options().texture_size_texels};
}

TextureSlots slots_of(const SeamScene& scene) {
  TextureSlots slots;
  slots.has_images = true;
  for (std::uint32_t i = 0; i < scene.options().textures; ++i) {
    const std::string name = std::to_string(i);
    slots.slots.push_back({name, {.path = name}, size_of(scene), true, TexelKind::kByte, 0});
    slots.of_material.push_back(SlotId{i});
  }
  return slots;
}

SlotFrames frames_of(const SeamScene& scene) {
  SlotFrame frame;
  frame.has_size = frame.readable = true;
  frame.width = frame.height = scene.options().texture_size_texels;
  return SlotFrames(std::vector<SlotFrame>(scene.options().textures, frame));
}

SeamSide side_of(const SceneSide& side) {
  SeamSide result;
  result.slot = SlotId{side.texture};
  for (std::size_t k = 0; k < 2; ++k) result.t[k] = {side.uv[k][0], side.uv[k][1]};
  return result;
}

SeamCandidate candidate(const SceneEdge& edge, std::uint32_t number) {
  SeamCandidate seam{};
  seam.v[0] = VertexId{2 * number};
  seam.v[1] = VertexId{2 * number + 1};
  seam.faces[0] = FaceId{2 * number};
  seam.faces[1] = FaceId{2 * number + 1};
  for (std::size_t k = 0; k < 2; ++k) seam.sides[k] = side_of(edge.sides[k]);
  seam.length_3d = static_cast<double>(edge.length_3d);
  seam.sampled = true;
  seam.runs_down[1] = true;
  return seam;
}

/// The colours of a texture are one, so the discrepancy of an edge is the distance of two.
double discrepancy_of(const SeamScene& scene, const SceneEdge& edge) {
  const auto a = scene.colour(edge.sides[0].texture), b = scene.colour(edge.sides[1].texture);
  double squares = 0;
  for (std::size_t c = 0; c < 3; ++c) squares += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(squares);
}

class SeamsJob : public Job {
 public:
  SeamsJob(const SeamScene& scene, Room room, std::size_t threads)
      : scene_(scene), room_(room), threads_(threads) {}

  void prepare() override {
    edges_ = {};
    results_ = {};
    const std::uint64_t texels = std::uint64_t{size_of(scene_).width} * size_of(scene_).height;
    engine_ =
        std::make_unique<BenchEngine>(room_, 3 * texels * scene_.options().textures, threads_);
    sinks_ = std::make_unique<CountingSinks>(threads_);
    SpillWriter<SeamCandidate> writer(engine_->engine().scratch);
    for (std::uint64_t i = 0; i < scene_.options().edges; ++i) {
      writer.push(candidate(scene_.edge(i), static_cast<std::uint32_t>(i)));
    }
    edges_ = writer.finish();
  }
  void run() override {
    SeamPlan plan;
    plan.decode.model = "none";
    plan.decode.open_image = [this](const ImageSource& image) {
      const auto texture = static_cast<std::uint32_t>(std::stoul(image.path));
      return std::make_unique<ColourRows>(size_of(scene_), scene_.colour(texture));
    };
    results_ = sample_seams(engine_->engine(), std::move(edges_), slots_, frames_, plan, warnings_,
                            *sinks_);
  }
  void check() override {
    double expected = 0;
    for (std::uint64_t i = 0; i < scene_.options().edges; ++i) {
      expected += discrepancy_of(scene_, scene_.edge(i));
    }
    const GroupCounts counts = sinks_->total();
    expect(counts.seams == scene_.options().edges, "seams are missing");
    expect(counts.sample_pairs == scene_.sample_pairs(), "samples are missing");
    expect(std::abs(counts.discrepancy - expected) <= 1e-9 * expected, "colours are others'");
    expect(engine_->kept_to_its_room(), "scratch is not where it should be");
  }

 private:
  const SeamScene& scene_;
  Room room_;
  std::size_t threads_;
  TextureSlots slots_ = slots_of(scene_);
  SlotFrames frames_ = frames_of(scene_);
  Warnings warnings_{{}, true};  // any is an error
  std::unique_ptr<BenchEngine> engine_;
  std::unique_ptr<CountingSinks> sinks_;
  Spill<SeamCandidate> edges_;
  SeamResults results_;
};

}  // namespace

int main(int argc, char** argv) {
  std::unique_ptr<SeamScene> scene;
  const auto jobs = [&](std::uint64_t edges) {
    SeamSceneOptions options;
    options.edges = edges;
    options.textures = 8;
    options.texture_size_texels = 1024;
    options.image_format = "png";
    options.content = SceneContent::kConstant;
    scene = std::make_unique<SeamScene>(options);
    const std::uint64_t pairs = scene->sample_pairs();
    std::vector<NamedJob> all;
    for (const Room room : {Room::kInMemory, Room::kBeyondMemory}) {
      for (const std::size_t threads : kThreads) {
        all.push_back({"seams/" + name_of(room) + "/threads:" + std::to_string(threads),
                       [=, &scene] { return std::make_unique<SeamsJob>(*scene, room, threads); },
                       "sample_pair", pairs});
      }
    }
    return all;
  };
  return run_subject(argc, argv, {"EDGES", 50'000, jobs});
}
