#include "io/image/image_reader.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "io/error.hpp"
#include "io/file/module.hpp"
#include "io/image/image_file.hpp"
#include "io/image/image_module.hpp"

namespace atlasgauge {
namespace {

using ErrorText = std::array<char, 512>;

template <class Function>
Function function_of_module(const char* symbol) {
  return reinterpret_cast<Function>(module_symbol(kImageModule, symbol));
}

/// The library puts several faults in as many lines; a message is one line.
std::string in_one_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) {
    text.replace(at, 1, "; ");
  }
  return text;
}

[[noreturn]] void fail(const std::string& path, const ErrorText& error) {
  throw Error(ErrorKind::kInput, path, 0, "cannot read the image: " + in_one_line(error.data()));
}

void close(void* image) {
  static const auto close_image = function_of_module<CloseImageFunction>(kCloseImageSymbol);
  close_image(image);
}

class ModuleRows final : public ImageRows {
 public:
  explicit ModuleRows(const ImageSource& source)
      : path_(source.path), file_(source), image_(nullptr, close) {
    static const auto open = function_of_module<OpenImageFunction>(kOpenImageSymbol);
    ErrorText error{};
    image_.reset(open(file_.path().c_str(), &header_, error.data(), error.size()));
    if (!image_) fail(path_, error);
    header_.decoder_bytes += file_.copied_bytes();
  }

  const ImageHeader& header() const override { return header_; }

  void read(std::uint32_t rows, std::byte* to) override {
    static const auto read_rows = function_of_module<ReadImageRowsFunction>(kReadImageRowsSymbol);
    ErrorText error{};
    if (!read_rows(image_.get(), rows, to, error.data(), error.size())) fail(path_, error);
  }

 private:
  std::string path_;
  ImageFile file_;
  ImageHeader header_;
  std::unique_ptr<void, void (*)(void*)> image_;
};

}  // namespace

ImageHeader read_image_header(const ImageSource& source) {
  static const auto read_header =
      function_of_module<ReadImageHeaderFunction>(kReadImageHeaderSymbol);
  const ImageFile file(source);
  ImageHeader header;
  ErrorText error{};
  if (!read_header(file.path().c_str(), &header, error.data(), error.size())) {
    fail(source.path, error);
  }
  header.decoder_bytes += file.copied_bytes();
  return header;
}

std::unique_ptr<ImageRows> open_image(const ImageSource& source) {
  return std::make_unique<ModuleRows>(source);
}

}  // namespace atlasgauge
