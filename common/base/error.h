// error.h: the one exception for what a user, a file or a peer did wrong, and the check for our own bugs.
//
// Error   a file, flag, peer or message is bad. Its text is one line: what, where, what to do about it.
//         Whoever owns the conversation (main, a connection) catches it and reports it; a peer's Error
//         ends that peer's connection, never the program.
// CHECK   our own assumption is broken: prints the expression, its values and the place, then aborts
//         (check.h).
// Threads: all functions may be called from any thread.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>

#include "common/base/check.h"

namespace ninefold {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws Error with the formatted text.
template <typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace ninefold
