// error.h: the one exception for what a user, a file or a peer did wrong.
//
// Error   A file, flag, peer or message is bad. The text is one line: what, where, what to do.
//         Whoever owns the conversation (main, a connection) catches and reports it. A peer's
//         Error ends that peer's connection, never the program.
// CHECK   Our own assumption is broken: the program prints it and aborts (check.h).
//
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
