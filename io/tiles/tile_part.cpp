#include "io/tiles/tile_part.hpp"

#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

TilePart::TilePart(std::unique_ptr<MeshPart> part, std::shared_ptr<TileState> tile)
    : part_(std::move(part)), tile_(std::move(tile)) {}

void TilePart::load() {
  try {
    part_->load();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    fault_ = error.what();
  }
}

void TilePart::emit(MeshSink& sink, Warnings& warnings) {
  if (!fault_) return part_->emit(sink, warnings);
  if (std::exchange(tile_->is_unreadable, true)) return;
  warnings.add(kTileUnreadable, tile_->tileset, 0, *fault_ + "; this part of the tile is left out");
}

std::optional<Quantization> TilePart::quantization() const {
  return fault_ ? std::nullopt : part_->quantization();
}

}  // namespace atlasgauge
