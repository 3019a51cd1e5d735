// secure_socket.h: a TCP socket with its TLS session, for coroutines of one loop. Internal to the
// connection.
// Errors: coroutines throw Error (TlsError from TLS), also when the socket was closed on purpose.
// Threads: the loop's.   Owner: shared by the coroutines that use it.
#pragma once

#include <atomic>

#include "proto/asio.h"
#include "proto/tls.h"

namespace ninefold {

// Thrown when the network fails or the peer closes.
class LostError : public Error {
 public:
  using Error::Error;
};

class SecureSocket {
 public:
  SecureSocket(tcp::socket socket, std::shared_ptr<const TlsContext> context);

  // Proves both sides to each other. The peer may use kHandshakeBytes for that. On failure the peer
  // is told why.
  asio::awaitable<void> handshake();
  // Plain bytes that the network has already brought; 0 if there are none.
  size_t readReceived(std::span<std::byte> into) { return tls_.read(into); }
  // Plain bytes; 0 when the peer has ended its side in order.
  asio::awaitable<size_t> read(std::span<std::byte> into);
  // Queues plain bytes for flush().
  void write(ByteView plain);
  // Encrypted bytes wait for flush().
  bool hasOutput() { return !tls_.output().empty(); }
  // Sends what is queued; `moved` is called whenever the network has taken some of it.
  asio::awaitable<void> flush(std::function<void()> moved);
  // Ends our side in order, after what was flushed.
  asio::awaitable<void> end();
  void close();  // at once; running operations fail

  KeyUse keyUse() const { return tls_.keyUse(); }
  const std::string& peer() const { return peer_; }
  const std::atomic<uint64_t>& received() const { return received_; }
  const std::atomic<uint64_t>& sent() const { return sent_; }
  // The kernel's latest measurement of what it could deliver [bytes/s]; 0 if it has none.
  double lineRate();

 private:
  asio::awaitable<void> receive(size_t most);
  asio::awaitable<void> shakeHands();

  tcp::socket socket_;
  TlsSession tls_;
  std::string peer_;
  Bytes in_, sending_;
  uint64_t underThisKey_ = 0;  // bytes written
  std::atomic<uint64_t> received_{0}, sent_{0};
};

std::string textOf(const tcp::endpoint& endpoint);

}  // namespace ninefold
