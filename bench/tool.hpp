#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "io/error.hpp"

namespace atlasgauge {

/// The frame of a tool's main: reads its command line, works, tells an error under its name.
/// Returns the exit code: that of `work`, or of the error as the program has them.
template <class Work>
int run_tool(const char* name, CLI::App& app, int argc, char** argv, Work work) {
  try {
    app.parse(argc, argv);
    return work();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ErrorKind::kUsage);
  } catch (const Error& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return static_cast<int>(error.kind());
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return static_cast<int>(ErrorKind::kInternal);
  }
}

}  // namespace atlasgauge
