// descriptor.h: a file descriptor that closes itself.
// Owner: the descriptor. Threads: one owner at a time. Errors: none; one below 0 is no descriptor.
#pragma once

#include <unistd.h>

#include <utility>

namespace ninefold {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  explicit operator bool() const { return fd_ >= 0; }
  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

}  // namespace ninefold
