#pragma once

#include <functional>
#include <string>
#include <utility>

namespace atlasgauge {

/// Is told of files that an input is made of besides the one that names it: of each when it is
/// first looked at, there or not, and maybe again. Of images only where they are sought under a
/// name that the input does not spell out; the others are among the materials.
class FileListener {
 public:
  /// Hears nothing.
  FileListener() = default;
  explicit FileListener(std::function<void(const std::string& path)> hear)
      : hear_(std::move(hear)) {}

  void tell(const std::string& path) const {
    if (hear_) hear_(path);
  }

 private:
  std::function<void(const std::string& path)> hear_;
};

}  // namespace atlasgauge
