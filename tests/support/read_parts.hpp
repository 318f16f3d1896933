#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/model/part_reader.hpp"
#include "tests/support/collect_sink.hpp"

namespace atlasgauge {

/// All that a part says.
struct PartContent : MeshSink {
  void add(const MeshBatch& batch) override {
    mesh.add(batch);
    invalid_polygons += batch.invalid_polygons;
    ++batches;
  }

  CollectSink mesh;
  std::uint64_t invalid_polygons = 0;
  std::uint64_t batches = 0;
  PartCounts promised;
  std::uint64_t memory_bytes = 0;
  std::optional<Quantization> quantization;
};

/// All that an input says.
struct PartsContent {
  std::vector<PartContent> parts;
  PartMaterials materials;
  std::vector<std::string> messages;
  std::map<std::string, std::uint64_t> warnings;  // by kind

  const CollectSink& mesh(std::size_t part = 0) const { return parts.at(part).mesh; }
};

/// `make_reader` makes a reader of warnings.
template <class MakeReader>
PartsContent read_parts(const MakeReader& make_reader, bool strict = false) {
  PartsContent content;
  Warnings warnings([&](const std::string& text) { content.messages.push_back(text); }, strict);
  auto reader = make_reader(warnings);
  while (const std::unique_ptr<MeshPart> part = reader.next()) {
    PartContent& read = content.parts.emplace_back();
    read.promised = part->counts();
    read.memory_bytes = part->memory_bytes();
    part->load();
    part->emit(read, warnings);
    read.quantization = part->quantization();
  }
  content.materials = reader.materials();
  content.warnings = warnings.totals();
  return content;
}

}  // namespace atlasgauge
