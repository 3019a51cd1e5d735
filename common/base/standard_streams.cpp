#include "common/base/standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <ctime>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr int kPatienceMs = 100;

// While it lives, a pipe without a reader is an error of ::write alone. The signal that comes with
// the error goes to the thread that writes; one from elsewhere is not lost.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const timespec atOnce{};
    if (came_) sigtimedwait(&pipe_, nullptr, &atOnce);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

  ssize_t write(int fd, std::string_view text) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    came_ = came_ || (n < 0 && errno == EPIPE);
    return n;
  }

 private:
  sigset_t pipe_, before_;
  bool came_ = false;
};

bool isOpen(int fd) { return ::fcntl(fd, F_GETFD) >= 0 || errno != EBADF; }

bool takesText(int fd) {
  pollfd stream{fd, POLLOUT, 0};
  return ::poll(&stream, 1, kPatienceMs) == 1;
}

}  // namespace

void prepareStreams() {
  // For reading only: writing to a stream that was closed gives an error.
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (!isOpen(fd) && ::open("/dev/null", O_RDONLY) != fd) _exit(1);
  ::signal(SIGXFSZ, SIG_IGN);
}

void sayToPeople(std::string_view text) {
  NoPipeSignal quietly;
  // A pipe that takes anything takes PIPE_BUF bytes without waiting.
  while (!text.empty() && takesText(STDERR_FILENO)) {
    const ssize_t n = quietly.write(STDERR_FILENO, text.substr(0, PIPE_BUF));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    text.remove_prefix(static_cast<size_t>(n));
  }
}

void writeOutput(std::string_view text) {
  NoPipeSignal quietly;
  while (!text.empty()) {
    const ssize_t n = quietly.write(STDOUT_FILENO, text);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("cannot write to standard output: {}", ::strerror(n < 0 ? errno : ENOSPC));
    text.remove_prefix(static_cast<size_t>(n));
  }
}

}  // namespace ninefold
