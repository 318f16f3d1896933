#include "io/corpus/xxh3_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <new>

namespace atlasgauge {

Xxh3Hash::Xxh3Hash() : state_(XXH3_createState()) {
  if (state_ == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(state_.get());
}

void Xxh3Hash::Free::operator()(XXH3_state_s* state) const {
  XXH3_freeState(state);
}

void Xxh3Hash::add(std::string_view bytes) {
  XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
}

std::array<unsigned char, Xxh3Hash::kBytes> Xxh3Hash::bytes() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_.get()));
  std::array<unsigned char, kBytes> bytes{};
  std::ranges::copy(canonical.digest, bytes.begin());
  return bytes;
}

std::string Xxh3Hash::hex() const {
  std::string text;
  for (const unsigned char byte : bytes()) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace atlasgauge
