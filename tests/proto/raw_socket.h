// raw_socket.h: a plain TCP socket on loopback for peers that misbehave. Blocking; closes itself.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <utility>

#include "common/base/error.h"

namespace ninefold {

class RawSocket {
 public:
  static RawSocket dial(uint16_t port) {
    RawSocket raw(::socket(AF_INET, SOCK_STREAM, 0));
    const sockaddr_in at = loopback(port);
    NINEFOLD_CHECK(::connect(raw.fd_, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0);
    return raw;
  }
  // Listens on a free port; the kernel completes connections even if nobody accepts them.
  static RawSocket listen() {
    RawSocket raw(::socket(AF_INET, SOCK_STREAM, 0));
    const sockaddr_in at = loopback(0);
    NINEFOLD_CHECK(::bind(raw.fd_, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0);
    NINEFOLD_CHECK(::listen(raw.fd_, 8) == 0);
    return raw;
  }
  RawSocket accept() const { return RawSocket(::accept(fd_, nullptr, nullptr)); }
  uint16_t port() const {
    sockaddr_in at{};
    socklen_t size = sizeof at;
    NINEFOLD_CHECK(::getsockname(fd_, reinterpret_cast<sockaddr*>(&at), &size) == 0);
    return ntohs(at.sin_port);
  }
  // False when the peer has closed.
  bool send(const std::string& bytes) const {
    return ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  void endWriting() const { ::shutdown(fd_, SHUT_WR); }
  int descriptor() const { return fd_; }

  RawSocket(RawSocket&& o) noexcept : fd_(std::exchange(o.fd_, -1)) {}
  RawSocket& operator=(RawSocket&&) = delete;
  ~RawSocket() {
    if (fd_ >= 0) ::close(fd_);
  }

 private:
  explicit RawSocket(int fd) : fd_(fd) { NINEFOLD_CHECK(fd >= 0); }
  static sockaddr_in loopback(uint16_t port) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(port);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return at;
  }
  int fd_;
};

}  // namespace ninefold
