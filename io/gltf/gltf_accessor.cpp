#include "io/gltf/gltf_accessor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "io/error.hpp"
#include "io/file/little_endian.hpp"
#include "io/ids.hpp"

namespace atlasgauge {
namespace {

/// Corners are three a face.
constexpr std::uint64_t kMostElements = 3 * kMaxElements;

/// Checks that `source` lies within the view, and sets its data.
void place_in_view(AccessorSource& source, const ByteRange& view, std::uint64_t offset,
                   const std::string& path) {
  if (source.count == 0) {
    source.data = view.part(0, 0);
    return;
  }
  const std::uint64_t bytes = (source.count - 1) * source.stride + source.element_bytes();
  if (!view.holds(offset, bytes)) {
    throw Error(ErrorKind::kInput, path, 0,
                fmt::format("{} needs {} bytes from {} on of its buffer view, which has {}",
                            source.name, bytes, offset, view.size));
  }
  source.data = view.part(offset, bytes);
}

void check_count(const std::string& name, std::uint64_t count, const std::string& path) {
  if (count <= kMostElements) return;
  throw Error(ErrorKind::kResource, path, 0,
              fmt::format("{} has {} elements, more than the {} a model may have; split the model",
                          name, count, kMostElements));
}

bool is_index(GltfComponent type) {
  return type == GltfComponent::kUnsignedByte || type == GltfComponent::kUnsignedShort ||
         type == GltfComponent::kUnsignedInt;
}

std::shared_ptr<const SparseSource> find_sparse(const GltfSparse& sparse,
                                                const AccessorSource& source,
                                                GltfBuffers& buffers) {
  const std::string& path = buffers.path();
  if (sparse.count > source.count || !is_index(sparse.index_type)) {
    throw Error(ErrorKind::kInput, path, 0,
                source.name +
                    " replaces more elements than it has, or by indices that are not "
                    "unsigned integers");
  }
  auto found = std::make_shared<SparseSource>();
  found->indices.name = "the sparse indices of " + source.name;
  found->indices.type = sparse.index_type;
  found->values.name = "the sparse values of " + source.name;
  found->values.type = source.type;
  found->values.components = source.components;
  for (AccessorSource* const part : {&found->indices, &found->values}) {
    part->count = sparse.count;
    part->stride = part->element_bytes();
  }
  place_in_view(found->indices, buffers.view(sparse.index_view, found->indices.name),
                sparse.index_offset, path);
  place_in_view(found->values, buffers.view(sparse.value_view, found->values.name),
                sparse.value_offset, path);
  return found;
}

template <class T>
double value_as(const char* component, bool normalized) {
  const auto value = static_cast<double>(read_number<T>(component));
  if (!normalized) return value;
  return std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

template <class T>
double step_of(bool normalized) {
  return normalized ? 1 / static_cast<double>(std::numeric_limits<T>::max()) : 1;
}

/// Hands out elements one by one.
class ElementCursor {
 public:
  ElementCursor(const AccessorSource& source, std::size_t block_elements)
      : blocks_(source, block_elements), element_bytes_(source.element_bytes()) {
    block_ = blocks_.next();
  }

  /// Null after the last.
  const char* get() const { return block_.empty() ? nullptr : block_.data(); }

  void advance() {
    block_ = block_.subspan(element_bytes_);
    if (block_.empty()) block_ = blocks_.next();
  }

 private:
  AccessorBlocks blocks_;
  std::size_t element_bytes_;
  std::span<const char> block_;
};

}  // namespace

/// Replaces elements of the blocks, which come in order.
class AccessorBlocks::Substitution {
 public:
  Substitution(const SparseSource& sparse, std::size_t block_elements)
      : index_type_(sparse.indices.type),
        element_bytes_(sparse.values.element_bytes()),
        indices_(sparse.indices, block_elements),
        values_(sparse.values, block_elements) {}

  /// `first` is the number of the first element in `block`.
  void apply(std::uint64_t first, std::span<char> block) {
    const std::uint64_t end = first + block.size() / element_bytes_;
    while (indices_.get() != nullptr) {
      const std::uint64_t index = index_value(indices_.get(), index_type_);
      if (index >= end) return;
      if (index >= first) {
        std::memcpy(&block[(index - first) * element_bytes_], values_.get(), element_bytes_);
      }
      indices_.advance();
      values_.advance();
    }
  }

 private:
  GltfComponent index_type_;
  std::size_t element_bytes_;
  ElementCursor indices_;
  ElementCursor values_;
};

AccessorBlocks::AccessorBlocks(const AccessorSource& source, std::size_t block_elements)
    : source_(source), block_elements_(std::max<std::size_t>(block_elements, 1)) {
  if (source.data) file_.emplace(*source.data);
  if (source.sparse != nullptr) {
    substitution_ = std::make_unique<Substitution>(*source.sparse, block_elements_);
  }
}

AccessorBlocks::AccessorBlocks(AccessorBlocks&&) noexcept = default;
AccessorBlocks::~AccessorBlocks() = default;

std::span<const char> AccessorBlocks::next() {
  const std::size_t elements = std::min<std::uint64_t>(block_elements_, source_.count - done_);
  block_.assign(elements * source_.element_bytes(), 0);
  if (elements == 0) return {};
  if (file_) read_data(elements);
  if (substitution_ != nullptr) substitution_->apply(done_, block_);
  done_ += elements;
  return block_;
}

void AccessorBlocks::read_data(std::size_t elements) {
  const std::size_t element_bytes = source_.element_bytes();
  const std::uint64_t begin = done_ * source_.stride;
  if (source_.stride == element_bytes) return file_->read(begin, block_.data(), block_.size());
  raw_.resize((elements - 1) * source_.stride + element_bytes);
  file_->read(begin, raw_.data(), raw_.size());
  for (std::size_t i = 0; i < elements; ++i) {
    std::memcpy(&block_[i * element_bytes], &raw_[i * source_.stride], element_bytes);
  }
}

AccessorSource find_accessor(const GltfModel& model, GltfBuffers& buffers, std::uint32_t accessor) {
  const std::string name = fmt::format("accessor {}", accessor);
  const std::string& path = buffers.path();
  if (accessor >= model.accessors.size()) {
    throw Error(
        ErrorKind::kInput, path, 0,
        fmt::format("a primitive names {}, but there are {}", name, model.accessors.size()));
  }
  const GltfAccessor& found = model.accessors[accessor];
  check_count(name, found.count, path);
  AccessorSource source;
  source.name = name;
  source.type = found.type;
  source.normalized = found.normalized;
  source.components = found.components;
  source.count = found.count;
  source.stride = source.element_bytes();
  if (found.view) {
    const ByteRange view = buffers.view(*found.view, name);
    const std::uint32_t stride = model.views[*found.view].byte_stride;
    if (stride != 0) source.stride = stride;
    place_in_view(source, view, found.byte_offset, path);
  }
  if (found.sparse) source.sparse = find_sparse(*found.sparse, source, buffers);
  return source;
}

std::vector<std::uint32_t> views_of(const GltfAccessor& accessor) {
  std::vector<std::uint32_t> views;
  if (accessor.view) views.push_back(*accessor.view);
  if (accessor.sparse) {
    views.push_back(accessor.sparse->index_view);
    views.push_back(accessor.sparse->value_view);
  }
  return views;
}

void check_sparse(const AccessorSource& source, std::size_t block_elements) {
  if (source.sparse == nullptr) return;
  const AccessorSource& indices = source.sparse->indices;
  std::uint64_t least = 0;
  for (ElementCursor cursor(indices, block_elements); cursor.get() != nullptr; cursor.advance()) {
    const std::uint64_t index = index_value(cursor.get(), indices.type);
    if (index < least || index >= source.count) {
      throw Error(ErrorKind::kInput, indices.data->path, 0,
                  fmt::format("{} do not ascend, or name an element {} of {}", indices.name, index,
                              source.count));
    }
    least = index + 1;
  }
}

double component_value(const char* component, GltfComponent type, bool normalized) {
  switch (type) {
    case GltfComponent::kByte:
      return value_as<std::int8_t>(component, normalized);
    case GltfComponent::kUnsignedByte:
      return value_as<std::uint8_t>(component, normalized);
    case GltfComponent::kShort:
      return value_as<std::int16_t>(component, normalized);
    case GltfComponent::kUnsignedShort:
      return value_as<std::uint16_t>(component, normalized);
    case GltfComponent::kUnsignedInt:
      return value_as<std::uint32_t>(component, normalized);
    case GltfComponent::kFloat:
      break;
  }
  return read_number<float>(component);
}

std::uint32_t index_value(const char* component, GltfComponent type) {
  if (type == GltfComponent::kUnsignedByte) return read_number<std::uint8_t>(component);
  if (type == GltfComponent::kUnsignedShort) return read_number<std::uint16_t>(component);
  return read_number<std::uint32_t>(component);
}

double component_step(GltfComponent type, bool normalized) {
  switch (type) {
    case GltfComponent::kByte:
      return step_of<std::int8_t>(normalized);
    case GltfComponent::kUnsignedByte:
      return step_of<std::uint8_t>(normalized);
    case GltfComponent::kShort:
      return step_of<std::int16_t>(normalized);
    case GltfComponent::kUnsignedShort:
      return step_of<std::uint16_t>(normalized);
    case GltfComponent::kUnsignedInt:
    case GltfComponent::kFloat:
      break;
  }
  return 0;
}

}  // namespace atlasgauge
