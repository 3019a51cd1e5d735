#include "proto/secure_socket.h"

#include <algorithm>

#include "proto/line_rate.h"

namespace ninefold {
namespace {

constexpr size_t kHandshakeBytes = 4096;
constexpr size_t kReceiveBytes = 256 << 10;
constexpr uint64_t kBytesPerKey = 32ull << 30;  // small records included, far below AES-GCM's limit

}  // namespace

std::string textOf(const tcp::endpoint& endpoint) {
  const std::string address = endpoint.address().to_string();
  return endpoint.address().is_v6() ? fmt::format("[{}]:{}", address, endpoint.port())
                                    : fmt::format("{}:{}", address, endpoint.port());
}

SecureSocket::SecureSocket(tcp::socket socket, std::shared_ptr<const TlsContext> context)
    : socket_(std::move(socket)), tls_(std::move(context)), in_(kHandshakeBytes) {
  NetError ignored;
  peer_ = textOf(socket_.remote_endpoint(ignored));
  socket_.set_option(tcp::no_delay(true), ignored);
}

double SecureSocket::lineRate() { return deliveryRate(socket_.native_handle()); }

asio::awaitable<void> SecureSocket::receive(size_t most) {
  NetError error;
  const size_t got = co_await socket_.async_read_some(
      asio::buffer(in_.data(), most), asio::redirect_error(asio::use_awaitable, error));
  if (error == asio::error::eof || error == asio::error::connection_reset)
    throw LostError("the connection was lost");
  if (error) throw LostError(fmt::format("the network failed: {}", error.message()));
  received_ += got;
  tls_.receive(ByteView(in_).first(got));
}

asio::awaitable<void> SecureSocket::shakeHands() {
  while (!tls_.handshake()) {
    co_await flush([] {});
    const size_t left = kHandshakeBytes - std::min<size_t>(kHandshakeBytes, received_);
    if (left == 0)
      throw TlsError(TlsError::Kind::foreign, "it sends too much before it has shown its key");
    co_await receive(left);
  }
  co_await flush([] {});
}

asio::awaitable<void> SecureSocket::handshake() {
  std::exception_ptr failure;
  try {
    co_await shakeHands();
  } catch (const TlsError&) {
    failure = std::current_exception();
  }
  if (!failure) co_return;
  try {
    co_await flush([] {});  // the alert that says why
  } catch (const LostError&) {
  }
  std::rethrow_exception(failure);
}

asio::awaitable<size_t> SecureSocket::read(std::span<std::byte> into) {
  for (;;) {
    const size_t got = tls_.read(into);
    if (got > 0 || tls_.ended()) co_return got;
    // Only now is nothing of the smaller buffer in use.
    in_.resize(kReceiveBytes);
    co_await receive(in_.size());
  }
}

void SecureSocket::write(ByteView plain) {
  underThisKey_ += plain.size();
  if (underThisKey_ > kBytesPerKey) {
    tls_.renewKeys();
    underThisKey_ = 0;
  }
  tls_.write(plain);
}

asio::awaitable<void> SecureSocket::flush(std::function<void()> moved) {
  sending_.clear();
  std::swap(sending_, tls_.output());
  for (size_t done = 0; done < sending_.size();) {
    NetError error;
    const size_t put = co_await socket_.async_write_some(
        asio::buffer(sending_.data() + done, sending_.size() - done),
        asio::redirect_error(asio::use_awaitable, error));
    if (error) throw LostError(fmt::format("the connection was lost: {}", error.message()));
    done += put, sent_ += put;
    moved();
  }
}

asio::awaitable<void> SecureSocket::end() {
  tls_.end();
  co_await flush([] {});
  NetError ignored;
  socket_.shutdown(tcp::socket::shutdown_send, ignored);
}

void SecureSocket::close() {
  NetError ignored;
  socket_.close(ignored);
}

}  // namespace ninefold
