#include <filesystem>

#include "bench/site.hpp"
#include "bench/worst/families.hpp"

namespace atlasgauge {
namespace {

constexpr ImageSize kTexture{8192, 8192};

SiteOptions site_options(std::uint64_t faces, bool shuffle_faces, bool shuffle_vertices) {
  SiteOptions options;
  options.faces = faces;
  options.texture_size_texels = kTexture.width;
  options.image_format = ImageFormat::kNone;
  if (shuffle_faces) options.shuffle_seed = 1;
  if (shuffle_vertices) options.vertex_shuffle_seed = 2;
  return options;
}

template <bool kFaces, bool kVertices>
void write(std::uint64_t size, const std::string& stem) {
  const std::filesystem::path path(stem);
  SiteOptions options = site_options(size, kFaces, kVertices);
  options.name = path.filename().string();
  write_site(Site(options), path.parent_path().string());
}

Answers answers(std::uint64_t size) {
  return site_answers(Site(site_options(size, false, false)));
}

}  // namespace

std::vector<WorstCase> site_cases() {
  return {
      {"site", "nothing: what the others are compared to", "faces", write<false, false>, answers,
       kTexture},
      {"site_shuffled_faces", "locality of faces", "faces", write<true, false>, answers, kTexture},
      {"site_shuffled_vertices", "locality of vertices", "faces", write<false, true>, answers,
       kTexture},
      {"site_shuffled", "all locality", "faces", write<true, true>, answers, kTexture},
  };
}

}  // namespace atlasgauge
