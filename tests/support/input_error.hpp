#pragma once

#include <gtest/gtest.h>

#include <string>

#include "io/error.hpp"

namespace atlasgauge {

/// The text of the Error(kInput) that an action ends in; else what it ends in instead.
template <class Action>
std::string input_error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInput) return error.what();
    return std::string("not of kind kInput: ") + error.what();
  }
  return "no error";
}

/// Whether a message holds a phrase.
inline ::testing::AssertionResult says(const std::string& message, const std::string& phrase) {
  if (message.find(phrase) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << message << "' lacks '" << phrase << "'";
}

}  // namespace atlasgauge
