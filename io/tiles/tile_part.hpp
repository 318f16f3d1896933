#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/model/mesh_part.hpp"

namespace atlasgauge {

/// What the parts of a tile share.
struct TileState {
  std::string tileset;         ///< its path
  bool is_unreadable = false;  ///< it has been warned about
};

/// A part of a tile whose faults are warnings.
class TilePart : public MeshPart {
 public:
  TilePart(std::unique_ptr<MeshPart> part, std::shared_ptr<TileState> tile);

  PartCounts counts() const override { return part_->counts(); }
  std::uint64_t memory_bytes() const override { return part_->memory_bytes(); }
  void load() override;
  void emit(MeshSink& sink, Warnings& warnings) override;
  std::optional<Quantization> quantization() const override;

 private:
  std::unique_ptr<MeshPart> part_;
  std::shared_ptr<TileState> tile_;
  std::optional<std::string> fault_;
};

/// The kind of the warning.
inline constexpr const char* kTileUnreadable = "tiles unreadable";

}  // namespace atlasgauge
