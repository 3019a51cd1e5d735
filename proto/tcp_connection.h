// tcp_connection.h: a Connection on a SecureSocket: a reader, a writer and a watchdog coroutine.
// Internal.
#pragma once

#include <deque>
#include <mutex>

#include "proto/connection.h"
#include "proto/framing.h"
#include "proto/secure_socket.h"

namespace ninefold {

class TcpConnection : public Connection, public std::enable_shared_from_this<TcpConnection> {
 public:
  // `other` is what the peer is. The handshake is over.
  TcpConnection(asio::io_context& io, std::shared_ptr<SecureSocket> socket, Peer other,
                const ConnectionOptions& options);
  ~TcpConnection() override;

  void start(Events events) override;
  bool send(Message message) override;
  void finish(std::string reason) override;
  void close(std::string reason) override;

  KeyUse keyUse() const override { return socket_->keyUse(); }
  const std::string& peer() const override { return socket_->peer(); }
  uint64_t bytesReceived() const override { return socket_->received(); }
  uint64_t bytesSent() const override { return socket_->sent(); }
  double lineRate() override { return socket_->lineRate(); }

 private:
  enum class State : uint8_t { open, finishing, closing };

  asio::awaitable<void> readAll();
  asio::awaitable<void> writeAll();
  asio::awaitable<void> watch();
  asio::awaitable<void> readFrames();
  asio::awaitable<void> writeFrames();
  void heard(Frame&& frame);
  std::deque<Frame> takeBatch(size_t& bytes);
  void written(size_t bytes);
  State state();
  asio::awaitable<void> sleepUntilWoken();
  void closed(const std::string& reason);
  Time nextDeadline(Time now) const;
  std::string overdue(Time now) const;
  void wake();

  // Constant after construction.
  asio::io_context& io_;
  const std::shared_ptr<SecureSocket> socket_;
  const Peer other_;
  const ConnectionOptions options_;

  // The loop's thread only.
  Events events_;
  Bytes plain_;  // of the batch that is being written
  FrameParser parser_{messageLimit};
  asio::steady_timer wakeWriter_, wakeWatch_;
  bool started_ = false, isClosed_ = false, heardFirst_ = false;
  Time readDeadline_ = Time::max(), writeDeadline_ = Time::max(), finishDeadline_ = Time::max();
  std::string finishReason_, closeReason_;

  // Any thread.
  std::mutex mutex_;
  State state_ = State::open;  // guarded by mutex_
  std::deque<Frame> queue_;    // guarded by mutex_
  size_t queuedBytes_ = 0;     // guarded by mutex_; includes what is being written
  bool writerSleeps_ = false;  // guarded by mutex_
};

}  // namespace ninefold
