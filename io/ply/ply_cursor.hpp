#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

#include "io/mesh_batch.hpp"
#include "io/obj/obj_numbers.hpp"
#include "io/ply/ply_header.hpp"
#include "io/ply/ply_input.hpp"

namespace atlasgauge {

/// Where in the body a cursor is, for messages.
struct PlyPlace {
  const std::string& path;
  const PlyElement* element = nullptr;
  std::uint64_t record = 0;  ///< of the element, from 0
};

/// Throw Error(kInput). `line` is 0 in binary files, which have an offset instead.
[[noreturn]] void refuse_ply_end(const PlyPlace& place, std::uint64_t line, std::uint64_t offset);
[[noreturn]] void refuse_ply_word(const PlyPlace& place, std::uint64_t line, std::string_view word);
[[noreturn]] void refuse_ply_length(const PlyPlace& place, std::uint64_t line, std::uint64_t offset,
                                    std::int64_t length);

/// What a number says as an index: -1 for what is no integer that an index could be.
inline std::int64_t as_index(double value) {
  const bool in_range = value >= -1 && value < 9e15;
  const std::int64_t index = in_range ? static_cast<std::int64_t>(value) : -1;
  return static_cast<double>(index) == value ? index : -1;
}

/// Both cursors hand out values in file order:
///
///   real()     as the declared type stores it
///   real32()   rounded to float once
///   integer()  -1 for a fraction where an integer is expected
///   length()   of a list
///   skip()     values of a type
///   end_record()  false if a line has more than its record, which is skipped
///   line()     0 in a binary file
///
/// All throw Error(kInput) at the end of the file.

/// Words of an ascii body.
class PlyTextCursor {
 public:
  PlyTextCursor(PlyInput& input, PlyPlace& place) : input_(input), place_(place) {}

  double real(PlyType type) {
    if (type == PlyType::kFloat32) return real32(type);
    const char* const p = word();
    double value = 0;
    accept(p, read_double(p, value));
    return value;
  }

  float real32(PlyType) {
    const char* const p = word();
    float value = 0;
    accept(p, read_float(p, value));
    return value;
  }

  std::int64_t integer(PlyType) {
    const char* const p = word();
    std::int64_t value = 0;
    const char* const end = read_index(p, value);
    if (end == nullptr || !is_word_end(*end)) return as_index(real(PlyType::kFloat64));
    accept(p, end);
    return value;
  }

  std::uint64_t length(PlyType type) {
    const std::int64_t value = integer(type);
    if (value < 0) refuse_ply_length(place_, line(), 0, value);
    return static_cast<std::uint64_t>(value);
  }

  void skip(PlyType, std::uint64_t count) {
    for (; count > 0; --count) {
      const char* const p = word();
      const char* const end = skip_word(p);
      if (end - p > kMaxWord) refuse_ply_word(place_, line(), {p, kMaxWord});
      input_.go_to(end);
    }
  }

  bool end_record() { return input_.end_line(); }
  std::uint64_t line() const { return input_.line(); }
  bool at_end() { return input_.word() == nullptr; }

 private:
  static constexpr std::ptrdiff_t kMaxWord = PlyInput::kMaxWordBytes;

  const char* word() {
    const char* const p = input_.word();
    if (p == nullptr) refuse_ply_end(place_, line(), 0);
    return p;
  }

  /// Goes on behind a word that was read up to `end`, nullptr where it could not be.
  void accept(const char* p, const char* end) {
    if (end == nullptr || end - p > kMaxWord) [[unlikely]] {
      refuse_ply_word(place_, line(), word_at(p));
    }
    input_.go_to(end);
  }

  PlyInput& input_;
  PlyPlace& place_;
};

/// Numbers of a binary body.
template <std::endian kOrder>
class PlyBinaryCursor {
 public:
  PlyBinaryCursor(PlyInput& input, PlyPlace& place) : input_(input), place_(place) {}

  double real(PlyType type) { return load_as<double>(type) + 0.0; }
  float real32(PlyType type) { return load_as<float>(type) + 0.0F; }

  std::int64_t integer(PlyType type) {
    return is_integer(type) ? load_as<std::int64_t>(type) : as_index(load_as<double>(type));
  }

  std::uint64_t length(PlyType type) {
    const auto value = load_as<std::int64_t>(type);
    if (value < 0) refuse_ply_length(place_, 0, input_.offset(), value);
    return static_cast<std::uint64_t>(value);
  }

  void skip(PlyType type, std::uint64_t count) {
    const bool is_whole = count <= UINT64_MAX / 8 && input_.skip(count * bytes_of(type));
    if (!is_whole) refuse_ply_end(place_, 0, input_.offset());
  }

  bool end_record() { return true; }
  std::uint64_t line() const { return 0; }
  bool at_end() { return input_.at_end(); }

 private:
  template <class T>
  T load() {
    const char* const p = input_.bytes(sizeof(T));
    if (p == nullptr) [[unlikely]] {
      refuse_ply_end(place_, 0, input_.offset());
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, p, sizeof(T));
    if constexpr (kOrder != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
    input_.go_to(p + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  template <class Value>
  Value load_as(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return static_cast<Value>(load<std::int8_t>());
      case PlyType::kUint8:
        return static_cast<Value>(load<std::uint8_t>());
      case PlyType::kInt16:
        return static_cast<Value>(load<std::int16_t>());
      case PlyType::kUint16:
        return static_cast<Value>(load<std::uint16_t>());
      case PlyType::kInt32:
        return static_cast<Value>(load<std::int32_t>());
      case PlyType::kUint32:
        return static_cast<Value>(load<std::uint32_t>());
      case PlyType::kFloat32:
        return static_cast<Value>(load<float>());
      case PlyType::kFloat64:
        return static_cast<Value>(load<double>());
    }
    return Value{};
  }

  PlyInput& input_;
  PlyPlace& place_;
};

}  // namespace atlasgauge
