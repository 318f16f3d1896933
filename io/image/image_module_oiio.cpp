#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "io/image/image_header.hpp"
#include "io/image/image_module_decoder.hpp"
#include "io/image/image_module_guard.hpp"

using atlasgauge::Decoder;
using atlasgauge::ImageHeader;
using atlasgauge::tell_fault;

extern "C" {

__attribute__((visibility("default"))) bool atlasgauge_read_image_header(const char* path,
                                                                         ImageHeader* header,
                                                                         char* error,
                                                                         std::size_t error_bytes) {
  const auto work = [&] {
    *header = Decoder(path).header();
    return std::string();
  };
  return tell_fault(work, error, error_bytes);
}

__attribute__((visibility("default"))) void* atlasgauge_open_image(const char* path,
                                                                   ImageHeader* header, char* error,
                                                                   std::size_t error_bytes) {
  std::unique_ptr<Decoder> image;
  const auto work = [&] {
    image = std::make_unique<Decoder>(path);
    *header = image->header();
    return std::string();
  };
  return tell_fault(work, error, error_bytes) ? image.release() : nullptr;
}

__attribute__((visibility("default"))) bool atlasgauge_read_image_rows(void* image,
                                                                       std::uint32_t rows,
                                                                       std::byte* to, char* error,
                                                                       std::size_t error_bytes) {
  const auto work = [&] {
    static_cast<Decoder*>(image)->read(rows, to);
    return std::string();
  };
  return tell_fault(work, error, error_bytes);
}

__attribute__((visibility("default"))) void atlasgauge_close_image(void* image) {
  delete static_cast<Decoder*>(image);
}

}  // extern "C"
