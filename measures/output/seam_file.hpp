#pragma once

#include <memory>
#include <string>

#include "stream/engine/engine.hpp"
#include "stream/groups.hpp"

namespace atlasgauge {

/// A file of all seam edges, that is there whole or not at all.
class SeamFile {
 public:
  virtual ~SeamFile() = default;
  /// All of them, once.
  virtual void write(SeamRows& rows) = 0;
  virtual void commit() = 0;
};

/// A SeamPicture if the name ends in .ply, else a SeamTable. `texmetro`: with the number of
/// TexMetro, too. Throws Error(kUsage) for a suffix that is no format, Error(kResource).
std::unique_ptr<SeamFile> open_seam_file(const std::string& path, bool texmetro,
                                         const Engine& engine);

}  // namespace atlasgauge
