#include "io/file/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "io/error.hpp"
#include "io/file/output_target.hpp"

namespace atlasgauge {
namespace {

Descriptor open_standard_output() {
  return Descriptor(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0));
}

Descriptor open_special(const std::string& target) {
  return Descriptor(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
}

}  // namespace

void check_writable(const std::string& path) {
  if (path != "-") output_target(path);
}

OutputFile::OutputFile(const std::string& path)
    : target_(path == "-" ? "standard output" : output_target(path)) {
  buffer_.reserve(kBufferBytes);
  if (path != "-" && !is_special(target_)) {
    file_.emplace(target_);
    return;
  }
  special_ = path == "-" ? open_standard_output() : open_special(target_);
  if (!special_) fail_to_write(target_, errno_text());
}

void OutputFile::append(std::string_view text) {
  if (buffer_.size() + text.size() > kBufferBytes) flush();
  if (text.size() >= kBufferBytes) return write(text);
  buffer_ += text;
}

void OutputFile::commit() {
  flush();
  if (file_) file_->commit();
}

void OutputFile::write(std::string_view text) {
  file_ ? file_->append(text) : write_all(special_.get(), target_, text);
}

void OutputFile::flush() {
  write(buffer_);
  buffer_.clear();
}

void write_file(const std::string& path, std::string_view text) {
  OutputFile file(path);
  file.append(text);
  file.commit();
}

}  // namespace atlasgauge
