#pragma once

#include <optional>
#include <string>

namespace atlasgauge {

/// A shared object of this program that is loaded when first needed, because the libraries it
/// brings along are large.
struct Module {
  const char* file;     ///< name without a folder
  const char* purpose;  ///< as in "reads images"
  const char* remedy;   ///< what to do where it cannot be loaded
};

/// What `module` exports under the name `symbol`. The module is looked for beside the program and
/// where it is installed, and stays loaded until the program ends. Throws Error(kResource): another
/// machine may have what it lacks here.
void* module_symbol(const Module& module, const char* symbol);

/// Where it lies.
std::optional<std::string> module_path(const Module& module);

}  // namespace atlasgauge
