// one_line_error.h: what a failing call says to the user, which must be one line.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "common/base/error.h"

namespace ninefold {

// The message of the Error that `action` throws; a test failure if it throws none or several lines.
template <typename Action>
std::string errorOf(Action&& action) {
  try {
    action();
  } catch (const Error& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
  ADD_FAILURE() << "no Error was thrown";
  return {};
}

#define EXPECT_CONTAINS(text, part)               \
  EXPECT_NE((text).find(part), std::string::npos) \
      << "\"" << (text) << "\" lacks \"" << (part) << '"'

}  // namespace ninefold
