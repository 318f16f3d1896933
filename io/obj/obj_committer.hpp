#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_batch.hpp"
#include "io/obj/obj_block.hpp"
#include "io/obj/obj_long_line.hpp"
#include "io/obj/obj_names.hpp"
#include "io/obj/obj_summary.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Takes parsed blocks in file order, resolves what depends on the blocks before (negative
/// indices, materials, line numbers), warns, and hands the values to a sink.
class ObjCommitter {
 public:
  ObjCommitter(std::string path, Warnings& warnings);

  void commit(ObjBlock& block, MeshSink& sink);
  ObjSummary finish();
  std::vector<std::string> take_mtllib_lines();

 private:
  void commit_lines(ObjBlock& block, MeshSink& sink);
  void commit_values(ObjBlock& block, MeshSink& sink);
  void commit_piece(ObjBlock& block, MeshSink& sink);
  void commit_wide_line(ObjBlock& block, MeshSink& sink);

  void resolve_relative(ObjBlock& block);
  ObjDefect resolve_polygon(ObjBlock& block, std::size_t first_face, std::size_t end_face) const;
  void set_materials(ObjBlock& block);
  void warn_about(ObjBlock& block);
  void warn_about(ObjDefect defect, std::uint64_t line);
  void emit_forward(const ObjBlock& block, MeshSink& sink);

  ObjLongLine::Before here(std::uint64_t line) const;
  void feed_long_line(std::string_view text, ObjBlock& block, MeshSink& sink);
  void end_long_line(std::uint64_t line, MeshSink& sink);
  void emit(const MeshBatch& batch, MeshSink& sink);
  void end_long_polygon(std::uint64_t line, MeshSink& sink);

  std::string path_;
  Warnings& warnings_;
  ObjNames materials_;
  ObjNames libraries_;
  ObjSummary summary_;
  MaterialId material_ = kNone<MaterialId>;
  std::uint64_t lines_ = 0;                       // committed
  std::optional<std::uint64_t> long_line_begin_;  // its line, while in pieces of one
  ObjLongLine long_line_;
};

}  // namespace atlasgauge
