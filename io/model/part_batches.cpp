#include "io/model/part_batches.hpp"

#include <limits>

#include "io/model/element_room.hpp"

namespace atlasgauge {

PartBatches::PartBatches(const std::string& path, MeshSink& sink, Warnings& warnings)
    : path_(path), sink_(sink), values_(path, warnings) {
  positions_.reserve(kBatch);
  texcoords_.reserve(kBatch);
  faces_.reserve(kBatch);
}

void PartBatches::drop_polygon(const char* why, std::uint64_t line) {
  ++invalid_polygons_;
  values_.polygon_dropped(why, line);
}

void PartBatches::withdraw_polygon(std::uint64_t faces, std::uint64_t line) {
  const ForwardPolygon polygon{this->faces() - faces, faces,
                               std::numeric_limits<std::uint64_t>::max(), line};
  flush();
  sink_.add({.forward = {&polygon, 1}});
}

void PartBatches::finish() {
  flush();
  values_.finish();
}

void PartBatches::flush() {
  check_room(path_, "positions", positions_before_, positions_.size());
  check_room(path_, "texture coordinates", texcoords_before_, texcoords_.size());
  check_room(path_, "triangles", faces_before_, faces_.size());
  positions_before_ += positions_.size();
  texcoords_before_ += texcoords_.size();
  faces_before_ += faces_.size();
  sink_.add({.positions = positions_,
             .texcoords = texcoords_,
             .faces = faces_,
             .invalid_polygons = invalid_polygons_});
  positions_.clear();
  texcoords_.clear();
  faces_.clear();
  invalid_polygons_ = 0;
}

}  // namespace atlasgauge
