#include "measures/output/seam_file.hpp"

#include "io/suffix.hpp"
#include "measures/output/seam_picture.hpp"
#include "measures/output/seam_table.hpp"

namespace atlasgauge {

std::unique_ptr<SeamFile> open_seam_file(const std::string& path, bool texmetro,
                                         const Engine& engine) {
  if (has_suffix(path, ".ply")) return std::make_unique<SeamPicture>(path, engine);
  return std::make_unique<SeamTable>(path, texmetro);
}

}  // namespace atlasgauge
