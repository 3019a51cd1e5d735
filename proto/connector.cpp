#include "proto/deadline.h"
#include "proto/tcp_connection.h"

namespace ninefold {
namespace {

constexpr const char* kIfSilent =
    "look whether this is a master's port, and whether a firewall closes it";

class DialError : public Error {
 public:
  DialError(ConnectProblem problem, const std::string& line) : Error(line), problem(problem) {}
  ConnectProblem problem;
};

// One attempt: resolve, dial, shake hands. Its deadline closes whatever it is waiting for.
class Attempt : public std::enable_shared_from_this<Attempt> {
 public:
  Attempt(asio::io_context& io, const Endpoint& to, std::shared_ptr<const TlsContext> tls,
          const ConnectionOptions& options)
      : io_(io), resolver_(io), socket_(io), to_(to), tls_(std::move(tls)), options_(options) {}

  asio::awaitable<void> run(std::function<void(std::shared_ptr<Connection>)> onConnected,
                            std::function<void(const ConnectFailure&)> onFailed);

 private:
  asio::awaitable<std::shared_ptr<Connection>> dial();
  asio::awaitable<std::vector<tcp::endpoint>> resolve();
  asio::awaitable<void> reach(const std::vector<tcp::endpoint>& candidates);
  void giveUp();
  std::string where() const { return addressText(to_); }

  asio::io_context& io_;
  tcp::resolver resolver_;
  tcp::socket socket_;
  std::shared_ptr<SecureSocket> secure_;
  const Endpoint to_;
  const std::shared_ptr<const TlsContext> tls_;
  const ConnectionOptions options_;
};

DialError networkError(const std::string& where, const NetError& error) {
  if (error == asio::error::connection_refused)
    return {
        ConnectProblem::refused,
        fmt::format("cannot reach {}: nobody listens there; start ninefold-master with --listen",
                    where)};
  if (error == asio::error::timed_out)
    return {ConnectProblem::timedOut,
            fmt::format("cannot reach {}: no answer; {}", where, kIfSilent)};
  return {ConnectProblem::unreachable,
          fmt::format("cannot reach {}: {}; check the address and the network", where,
                      error.message())};
}

DialError handshakeError(const std::string& where, const TlsError& error) {
  if (error.kind() == TlsError::Kind::wrongKey)
    return {ConnectProblem::wrongKey,
            fmt::format("cannot join {}: {}; use the master's --key-file", where, error.what())};
  return {ConnectProblem::notNinefold,
          fmt::format("cannot join {}: {}; check address and port", where, error.what())};
}

asio::awaitable<std::vector<tcp::endpoint>> Attempt::resolve() {
  NetError error;
  const auto address = asio::ip::make_address(to_.host, error);
  if (!error) co_return std::vector{tcp::endpoint(address, to_.port)};
  const auto found = co_await resolver_.async_resolve(
      to_.host, std::to_string(to_.port), asio::redirect_error(asio::use_awaitable, error));
  if (error)
    throw DialError(ConnectProblem::badAddress,
                    fmt::format("cannot find {}: {}; check the name", to_.host, error.message()));
  std::vector<tcp::endpoint> endpoints;
  for (const auto& entry : found) endpoints.push_back(entry.endpoint());
  co_return endpoints;
}

asio::awaitable<void> Attempt::reach(const std::vector<tcp::endpoint>& candidates) {
  NetError error = asio::error::host_not_found;
  for (const tcp::endpoint& candidate : candidates) {
    NetError ignored;
    socket_.close(ignored);
    co_await socket_.async_connect(candidate, asio::redirect_error(asio::use_awaitable, error));
    if (!error) co_return;
  }
  throw networkError(where(), error);
}

asio::awaitable<std::shared_ptr<Connection>> Attempt::dial() {
  const std::vector<tcp::endpoint> candidates = co_await resolve();
  co_await reach(candidates);
  secure_ = std::make_shared<SecureSocket>(std::move(socket_), tls_);
  try {
    co_await secure_->handshake();
  } catch (const TlsError& error) {
    throw handshakeError(where(), error);
  } catch (const LostError& error) {
    throw DialError(
        ConnectProblem::lost,
        fmt::format("cannot join {}: it closed the connection; is it a Ninefold master?", where()));
  }
  co_return std::make_shared<TcpConnection>(io_, secure_, Peer::master, options_);
}

void Attempt::giveUp() {
  NetError ignored;
  resolver_.cancel();
  socket_.close(ignored);
  if (secure_) secure_->close();
}

asio::awaitable<void> Attempt::run(std::function<void(std::shared_ptr<Connection>)> onConnected,
                                   std::function<void(const ConnectFailure&)> onFailed) {
  std::shared_ptr<Connection> connection;
  ConnectFailure failure;
  bool late = false;
  {
    const Deadline deadline(io_, options_.handshake,
                            [self = shared_from_this()] { self->giveUp(); });
    try {
      connection = co_await dial();
    } catch (const DialError& error) {
      failure = {error.problem, error.what()};
    }
    late = deadline.passed();
  }
  if (late)
    failure = {ConnectProblem::timedOut,
               fmt::format("cannot reach {}: no answer within {:.1f} s; {}", where(),
                           seconds(options_.handshake), kIfSilent)};
  if (connection && !late) co_return onConnected(std::move(connection));
  if (secure_) secure_->close();
  onFailed(failure);
}

}  // namespace

void connect(EventLoop& loop, const Endpoint& to, KeyUse use, std::shared_ptr<const Key> key,
             std::function<void(std::shared_ptr<Connection>)> onConnected,
             std::function<void(const ConnectFailure&)> onFailed, ConnectionOptions options) {
  NINEFOLD_CHECK(key != nullptr);
  asio::io_context& io = loop.impl().io;
  auto attempt = std::make_shared<Attempt>(io, to, TlsContext::forClient(use, *key), options);
  asio::post(io,
             [&io, attempt, onConnected = std::move(onConnected), onFailed = std::move(onFailed)] {
               spawn(io, [=] { return attempt->run(onConnected, onFailed); });
             });
}

}  // namespace ninefold
