#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/mesh_batch.hpp"
#include "io/warnings.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/mesh/mesh_store.hpp"

namespace atlasgauge {

/// Puts parts into scratch, one after the other, and notes global facts on the way. Indices of a
/// part begin anew: they are shifted behind those of the parts before. Indices that name nothing in
/// their part name nothing in the model either: a polygon with such a vertex is left out, a texture
/// coordinate is none.
class PartSink : public MeshSink {
 public:
  PartSink(const Engine& engine, Warnings& warnings);

  /// `path` is for messages; materials of the part are numbered from `first_material` on. Of a part
  /// that is `alone` in its model, all indices stay as they are.
  void begin_part(const std::string& path, std::uint64_t first_material, bool alone = false);
  void add(const MeshBatch& batch) override;
  /// `position_step`: see PartStart.
  void end_part(double position_step);

  MeshStore finish();

 private:
  /// Faces [first, first + count) of the model, to be left out.
  struct Dropped {
    std::uint64_t first, count;
  };
  /// A part whose faces name texture coordinates that it does not have.
  struct LooseTexcoords {
    std::uint64_t first_face, end_face, end_texcoord;
  };
  /// Where the part that is being read begins.
  struct Begin {
    std::string path;
    std::uint64_t positions = 0, texcoords = 0, faces = 0, materials = 0;
    bool alone = false;
  };

  void note(const Position& p);
  void note(const TexCoord& t);
  void add_faces(std::span<const FaceRecord> faces);
  void append(std::span<const FaceRecord> faces);
  FaceRecord shifted(FaceRecord face);
  void make_room_for_part();
  void drop_polygons_of_no_vertex();
  void rewrite_faces();

  const Engine& engine_;
  Warnings& warnings_;
  MeshStore store_;
  SpillWriter<Position> positions_;
  SpillWriter<TexCoord> texcoords_;
  SpillWriter<FaceRecord> faces_;
  std::optional<SpillWriter<ForwardPolygon>> forward_;  // of this part
  SpillWriter<Dropped> dropped_;
  std::vector<LooseTexcoords> loose_;
  std::vector<FaceRecord> shifted_;
  Begin begin_;
  std::uint64_t end_texcoord_named_ = 0;  // by the faces of this part
};

}  // namespace atlasgauge
