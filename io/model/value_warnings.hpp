#pragma once

#include <cstdint>
#include <string>

#include "io/mesh_batch.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Warns about values and polygons as the OBJ reader does, kind for kind. The first few of a kind
/// get a message, the rest are counted at the end, so that a thousand of them cost nothing.
class ValueWarnings {
 public:
  ValueWarnings(const std::string& path, Warnings& warnings);

  /// `line` 0 where there are none.
  void check(const Position& position, std::uint64_t line);
  void check(const TexCoord& texcoord, std::uint64_t line);
  void polygon_dropped(const std::string& why, std::uint64_t line);
  /// Hands over what was only counted.
  void finish();

 private:
  struct Kind {
    const char* name;
    std::uint64_t shown = 0;
    std::uint64_t counted = 0;
  };
  void add(Kind& kind, std::uint64_t line, const std::string& text);

  const std::string& path_;
  Warnings& warnings_;
  Kind not_finite_{"coordinates not finite"};
  Kind invalid_{"faces invalid"};
};

inline void ValueWarnings::check(const Position& position, std::uint64_t line) {
  if (is_finite(position)) [[likely]] {
    return;
  }
  add(not_finite_, line,
      "the position is not finite: faces that use it are counted, but not measured");
}

inline void ValueWarnings::check(const TexCoord& texcoord, std::uint64_t line) {
  if (is_finite(texcoord)) [[likely]] {
    return;
  }
  add(not_finite_, line, "the texture coordinate is not finite: taken as none");
}

}  // namespace atlasgauge
