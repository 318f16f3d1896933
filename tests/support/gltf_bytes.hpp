#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace atlasgauge {

/// Numbers as they lie in a file.
template <class T, class... More>
std::string bytes_of(T first, More... more) {
  std::string bytes(sizeof first, '\0');
  std::memcpy(bytes.data(), &first, sizeof first);
  if constexpr (sizeof...(more) > 0) bytes += bytes_of<T>(static_cast<T>(more)...);
  return bytes;
}

inline std::string u32_bytes(std::size_t number) {
  return bytes_of(static_cast<std::uint32_t>(number));
}

inline std::string padded(std::string text, char with) {
  while (text.size() % 4 != 0) text.push_back(with);
  return text;
}

/// A GLB of a JSON text and, unless empty, a binary chunk.
inline std::string make_glb(const std::string& json, const std::string& binary = {}) {
  const std::string text = padded(json, ' ');
  std::string chunks = u32_bytes(text.size()) + "JSON" + text;
  if (!binary.empty()) {
    const std::string data = padded(binary, '\0');
    chunks += u32_bytes(data.size()) + std::string("BIN\0", 4) + data;
  }
  return "glTF" + u32_bytes(2) + u32_bytes(12 + chunks.size()) + chunks;
}

/// A Batched 3D Model without a batch table.
inline std::string make_b3dm(const std::string& glb, const std::string& feature_json = "{}",
                             const std::string& feature_binary = {}) {
  const std::string json = padded(feature_json, ' ');
  const std::size_t bytes = 28 + json.size() + feature_binary.size() + glb.size();
  return "b3dm" + u32_bytes(1) + u32_bytes(bytes) + u32_bytes(json.size()) +
         u32_bytes(feature_binary.size()) + u32_bytes(0) + u32_bytes(0) + json + feature_binary +
         glb;
}

/// A Composite of tiles.
template <class... Tiles>
std::string make_cmpt(const Tiles&... tiles) {
  const std::string inner = (std::string() + ... + tiles);
  return "cmpt" + u32_bytes(1) + u32_bytes(16 + inner.size()) + u32_bytes(sizeof...(tiles)) + inner;
}

inline std::string base64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text.push_back(i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=');
    }
  }
  return text;
}

}  // namespace atlasgauge
