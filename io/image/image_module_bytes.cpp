#include "io/image/image_module_bytes.hpp"

namespace atlasgauge {

std::uint64_t HeaderBytes::file_bytes() {
  const std::streamoff here = file_.tellg();
  file_.seekg(0, std::ios::end);
  const std::streamoff bytes = file_.tellg();
  file_.seekg(here);
  return bytes < 0 ? 0 : static_cast<std::uint64_t>(bytes);
}

std::uint8_t HeaderBytes::byte() {
  char byte = 0;
  file_.get(byte);
  return file_.good() ? static_cast<std::uint8_t>(byte) : std::uint8_t{0};
}

std::uint32_t HeaderBytes::big_endian(int bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8 | byte();
  return value;
}

std::uint32_t HeaderBytes::little_endian(int bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < bytes; ++i) value |= std::uint32_t{byte()} << (8 * i);
  return value;
}

std::string HeaderBytes::text(std::size_t bytes) {
  std::string text(bytes, '\0');
  file_.read(text.data(), static_cast<std::streamsize>(bytes));
  return text;
}

std::string HeaderBytes::text_to_zero(std::size_t most) {
  std::string text;
  while (text.size() < most) {
    const std::uint8_t next = byte();
    if (next == 0) break;
    text += static_cast<char>(next);
  }
  return text;
}

}  // namespace atlasgauge
