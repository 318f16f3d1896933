#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "io/error.hpp"

namespace atlasgauge {

/// Writes the state of partials as bytes: archive(a, b, ...) of plain values and of anything with
/// serialize().
class Saver {
 public:
  template <class... Values>
  void operator()(Values&... values) {
    (save(values), ...);
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  template <class Value>
  void save(Value& value) {
    if constexpr (requires { value.serialize(*this); }) {
      value.serialize(*this);
    } else {
      static_assert(std::is_trivially_copyable_v<Value>);
      for (const std::byte byte : std::bit_cast<std::array<std::byte, sizeof(Value)>>(value)) {
        bytes_.push_back(byte);
      }
    }
  }

  std::vector<std::byte> bytes_;
};

/// Reads what a Saver wrote, in the same order.
class Loader {
 public:
  explicit Loader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (load(values), ...);
  }

 private:
  template <class Value>
  void load(Value& value) {
    if constexpr (requires { value.serialize(*this); }) {
      value.serialize(*this);
    } else {
      static_assert(std::is_trivially_copyable_v<Value>);
      if (rest_.size() < sizeof(Value)) {
        throw Error(ErrorKind::kInternal, "a saved partial is cut short");
      }
      std::memcpy(&value, rest_.data(), sizeof(Value));
      rest_ = rest_.subspan(sizeof(Value));
    }
  }

  std::span<const std::byte> rest_;
};

}  // namespace atlasgauge
