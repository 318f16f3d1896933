#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace atlasgauge {

/// XXH3-128 of bytes that come piece by piece.
class Xxh3Hash {
 public:
  static constexpr std::size_t kBytes = 16;

  Xxh3Hash();

  void add(std::string_view bytes);

  /// Of all bytes so far, the most significant byte first.
  std::array<unsigned char, kBytes> bytes() const;
  std::string hex() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

}  // namespace atlasgauge
