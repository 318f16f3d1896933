#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "bench/worst_cases.hpp"

namespace atlasgauge {

/// What a failing test prints of its parameter.
inline void PrintTo(const WorstCase& worst_case, std::ostream* out) {
  *out << worst_case.name;
}

inline std::string name_of(const testing::TestParamInfo<WorstCase>& info) {
  return std::string(info.param.name);
}

}  // namespace atlasgauge
