#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/file/byte_range.hpp"
#include "io/gltf/gltf_buffers.hpp"
#include "io/gltf/gltf_model.hpp"

namespace atlasgauge {

struct SparseSource;

/// Where the elements of an accessor lie; all of them are there.
struct AccessorSource {
  std::string name;               ///< for messages: "accessor 3"
  std::optional<ByteRange> data;  ///< none: zeros
  std::uint32_t stride = 0;
  GltfComponent type = GltfComponent::kFloat;
  bool normalized = false;
  std::uint32_t components = 1;
  std::uint64_t count = 0;
  std::shared_ptr<const SparseSource> sparse;  ///< or null

  std::uint32_t element_bytes() const { return component_bytes(type) * components; }
};

/// Elements that replace others, and their indices in ascending order.
struct SparseSource {
  AccessorSource indices;
  AccessorSource values;
};

/// Throws Error(kInput) for an accessor that is not there, or reaches beyond its buffer view, and
/// Error(kResource) for one of more elements than a model may have.
AccessorSource find_accessor(const GltfModel& model, GltfBuffers& buffers, std::uint32_t accessor);

/// The buffer views that an accessor reads from.
std::vector<std::uint32_t> views_of(const GltfAccessor& accessor);

/// Reads the elements of an accessor from front to back, in blocks.
class AccessorBlocks {
 public:
  /// Blocks have at most `block_elements` elements.
  AccessorBlocks(const AccessorSource& source, std::size_t block_elements);
  AccessorBlocks(AccessorBlocks&&) noexcept;
  ~AccessorBlocks();

  /// The next elements side by side, without stride; none after the last. Until the next call.
  /// Throws Error(kInput).
  std::span<const char> next();

 private:
  class Substitution;

  void read_data(std::size_t elements);

  const AccessorSource& source_;
  std::size_t block_elements_;
  std::uint64_t done_ = 0;  // elements
  std::optional<RangeReader> file_;
  std::vector<char> raw_;
  std::vector<char> block_;
  std::unique_ptr<Substitution> substitution_;
};

/// Throws Error(kInput) unless the indices of a sparse accessor ascend and name elements of it.
/// Does nothing for one that is not sparse.
void check_sparse(const AccessorSource& source, std::size_t block_elements);

/// What a component means: the number itself or, normalized, a fraction of the largest (glTF 2.0,
/// section 3.11).
double component_value(const char* component, GltfComponent type, bool normalized);

/// An index of type kUnsignedByte, kUnsignedShort or kUnsignedInt.
std::uint32_t index_value(const char* component, GltfComponent type);

/// The distance of two neighbouring values of an integer component.
double component_step(GltfComponent type, bool normalized);

}  // namespace atlasgauge
