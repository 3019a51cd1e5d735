// error.h: the one exception for what a user, a file or a peer did wrong, and the check for our own bugs.
//
// Error   a file, flag, peer or message is bad. Its text is one line: what, where, what to do about it.
//         Whoever owns the conversation (main, a connection) catches it and reports it; a peer's Error
//         ends that peer's connection, never the program.
// CHECK   our own assumption is broken: prints the expression and place, then aborts.
// Threads: all functions may be called from any thread.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>

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

[[noreturn]] void checkFailed(const char* expression, const char* file, int line);

#define NINEFOLD_CHECK(expression) \
  ((expression) ? void(0) : ::ninefold::checkFailed(#expression, __FILE__, __LINE__))

}  // namespace ninefold
