#include "tests/support/program.hpp"

#include "tests/support/child.hpp"

namespace atlasgauge {

ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment) {
  ChildSetup setup;
  setup.program = program;
  setup.arguments = arguments;
  setup.environment = environment;
  return Child(setup).wait();
}

}  // namespace atlasgauge
