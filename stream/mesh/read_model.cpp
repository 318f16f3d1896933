#include "stream/mesh/read_model.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "io/file/byte_source.hpp"
#include "io/obj/obj_reader.hpp"
#include "stream/mesh/part_sink.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kLargestBlockBytes = 1 << 20;
constexpr std::size_t kSmallestBlockBytes = 4 << 10;

/// The largest block of text whose worst blow-up fits for every worker.
std::size_t choose_block_bytes(std::uint64_t memory_bytes, std::size_t workers) {
  std::size_t block = kLargestBlockBytes;
  while (block > kSmallestBlockBytes && workers * ObjReader::memory_bytes(block) > memory_bytes) {
    block /= 2;
  }
  return block;
}

std::uint64_t bytes_of_file(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  return error ? 0 : bytes;
}

std::uint64_t bytes_of_files(std::span<const std::string> paths) {
  std::uint64_t bytes = 0;
  for (const std::string& path : paths) bytes += bytes_of_file(path);
  return bytes;
}

/// Hands batches on, and remembers which materials their faces name.
class MaterialsSeen : public MeshSink {
 public:
  explicit MaterialsSeen(MeshSink& to) : to_(to) {}

  void add(const MeshBatch& batch) override {
    for (const FaceRecord& face : batch.faces) {
      if (face.material == kNone<MaterialId> || face.material == last_) continue;
      last_ = face.material;
      if (std::ranges::find(all_, last_) == all_.end()) all_.push_back(last_);
    }
    to_.add(batch);
  }

  const std::vector<MaterialId>& all() const { return all_; }

 private:
  MeshSink& to_;
  MaterialId last_ = kNone<MaterialId>;
  std::vector<MaterialId> all_;
};

std::uint32_t fewer(std::uint32_t bits, std::uint32_t other) {
  return bits == 0 ? other : std::min(bits, other);
}

void note_part(const Quantization& part, const std::vector<MaterialId>& materials,
               InputQuantization& input) {
  ++input.quantized_parts;
  if (part.position_bits > 0) {
    input.position_bits = fewer(input.position_bits, part.position_bits);
    input.position_step = std::max(input.position_step, part.position_step);
  }
  if (part.uv_bits == 0) return;
  input.uv_bits = fewer(input.uv_bits, part.uv_bits);
  for (const MaterialId material : materials) {
    if (raw(material) >= input.uv_steps.size()) input.uv_steps.resize(raw(material) + 1ULL, 0.0);
    double& step = input.uv_steps[raw(material)];
    step = std::max(step, part.uv_step);
  }
}

/// What the readers of all inputs share.
struct Reading {
  const Engine& engine;
  Warnings& warnings;
  PartSink& sink;
  StageLog::Stage& stage;
  bool one_input;
  std::uint64_t bytes_before = 0;      ///< of the inputs before
  std::uint64_t materials_before = 0;  ///< likewise
};

InputMaterials read_obj(Reading& reading, const std::string& path) {
  const Engine& engine = reading.engine;
  const std::unique_ptr<ByteSource> source = open_byte_source(path);
  const std::size_t workers = engine.workers.count();
  const std::uint64_t writers_bytes = 4 * engine.block_bytes();
  const std::uint64_t free_bytes = engine.budget.free_bytes();
  const std::size_t block_bytes =
      choose_block_bytes(free_bytes - std::min(free_bytes, writers_bytes), workers);
  const Reservation memory = engine.budget.reserve(
      writers_bytes + workers * ObjReader::memory_bytes(block_bytes), "reading the model");

  ObjReader reader(*source, path, reading.warnings, block_bytes);
  reading.sink.begin_part(path, reading.materials_before, reading.one_input);
  std::vector<ObjBlock> blocks(workers);
  Workers::Pipeline pipeline;
  pipeline.produce = [&](std::size_t worker) { return reader.next(blocks[worker]); };
  pipeline.transform = [&](std::size_t worker) { reader.parse(blocks[worker]); };
  pipeline.commit = [&](std::size_t worker) {
    reader.commit(blocks[worker], reading.sink);
    reading.stage.progress(reading.bytes_before + source->consumed_bytes());
  };
  engine.workers.run(pipeline);
  ObjSummary summary = reader.finish();
  reading.sink.add({.invalid_polygons = summary.invalid_polygons});
  reading.sink.end_part(0);
  return {path, ObjMaterials{std::move(summary.mtllib_lines), std::move(summary.material_names)}};
}

/// Loads the parts of one input on all workers and hands them out in order.
///
/// A part is loaded as soon as a worker takes it, if there is memory for it beside those under way,
/// and some to spare for what grows with the number of parts. Else it, and every part taken after
/// it, waits until the parts before it are handed out and gone: then nothing else holds memory, so
/// that what does not fit then never would.
class PartLoading {
 public:
  PartLoading(Reading& reading, const std::string& path, PartReader& reader)
      : reading_(reading), path_(path), reader_(reader), items_(reading.engine.workers.count()) {
    quantization_.path = path;
    quantization_.first_material = reading.materials_before;
  }

  void run() {
    Workers::Pipeline pipeline;
    pipeline.produce = [this](std::size_t worker) { return take(items_[worker]); };
    pipeline.transform = [this](std::size_t worker) {
      if (!items_[worker].waits) items_[worker].part->load();
    };
    pipeline.commit = [this](std::size_t worker) { hand_out(items_[worker]); };
    reading_.engine.workers.run(pipeline);
  }

  const InputQuantization& quantization() const { return quantization_; }

 private:
  static constexpr std::uint64_t kSpareShare = 16;  // of the budget

  struct Item {
    std::unique_ptr<MeshPart> part;
    Reservation memory;
    bool waits = false;
  };

  bool take(Item& item) {
    item.part = reader_.next();
    if (!item.part) return false;
    const std::uint64_t bytes = item.part->memory_bytes();
    const MemoryBudget& budget = reading_.engine.budget;
    item.waits = waiting_ > 0 || bytes + budget.limit_bytes() / kSpareShare > budget.free_bytes();
    if (item.waits) {
      ++waiting_;
    } else {
      item.memory = reserve(bytes);
    }
    return true;
  }

  void hand_out(Item& item) {
    reading_.sink.begin_part(path_, reading_.materials_before);
    if (item.waits) {
      item.memory = reserve(item.part->memory_bytes());
      item.part->load();
    }
    MaterialsSeen materials(reading_.sink);
    item.part->emit(materials, reading_.warnings);
    const std::optional<Quantization> quantization = item.part->quantization();
    reading_.sink.end_part(quantization ? quantization->position_step : 0);
    ++quantization_.parts;
    if (quantization) note_part(*quantization, materials.all(), quantization_);
    item.part.reset();
    item.memory.release();
    if (item.waits) --waiting_;
  }

  Reservation reserve(std::uint64_t bytes) {
    return reading_.engine.budget.reserve(bytes, "decoding a part of " + path_);
  }

  Reading& reading_;
  const std::string& path_;
  PartReader& reader_;
  std::vector<Item> items_;
  std::atomic<std::size_t> waiting_ = 0;  // parts taken and not handed out yet, that wait
  InputQuantization quantization_;
};

void read_parts(Reading& reading, const std::string& path, PartReader& parts, ReadModel& model) {
  const Engine& engine = reading.engine;
  const Reservation writers = engine.budget.reserve(4 * engine.block_bytes(), "reading the model");
  PartLoading loading(reading, path, parts);
  loading.run();
  if (loading.quantization().quantized_parts > 0) {
    model.quantizations.push_back(loading.quantization());
  }
  model.materials.push_back({path, parts.materials()});
}

}  // namespace

ReadModel read_model(const Engine& engine, std::span<const std::string> inputs,
                     const OpenParts& open_parts, Warnings& warnings) {
  ReadModel model;
  StageLog::Stage stage(engine.log, "read", bytes_of_files(inputs));
  PartSink sink(engine, warnings);
  Reading reading{engine, warnings, sink, stage, inputs.size() == 1};
  for (const std::string& path : inputs) {
    if (const std::unique_ptr<PartReader> parts = open_parts(path, warnings)) {
      read_parts(reading, path, *parts, model);
    } else {
      model.materials.push_back(read_obj(reading, path));
    }
    reading.materials_before += model.materials.back().size();
    reading.bytes_before += bytes_of_file(path);
    stage.progress(reading.bytes_before);
  }
  model.mesh = sink.finish();
  return model;
}

}  // namespace atlasgauge
