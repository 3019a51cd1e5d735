#include <algorithm>
#include <list>

#include "proto/deadline.h"
#include "proto/line_limiter.h"
#include "proto/tcp_connection.h"

namespace ninefold {
namespace {

// A peer that has not yet shown that it holds a key.
struct Stranger {
  std::shared_ptr<SecureSocket> socket;
  std::string dropped;  // why we closed it ourselves
};

// Shared by the coroutines; the TcpListener that the owner holds only opens and stops it.
class Door : public std::enable_shared_from_this<Door> {
 public:
  Door(asio::io_context& io, Listener::Keys keys, Listener::Events events,
       ConnectionOptions options)
      : io_(io),
        acceptor_(io),
        tls_(TlsContext::forMaster(*keys.local, keys.cluster.get())),
        events_(std::move(events)),
        options_(options),
        refusals_(options.refusalLines, std::chrono::seconds(10)) {}

  uint16_t open(const tcp::endpoint& at) {
    NetError error;
    acceptor_.open(at.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(at, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error)
      fail("cannot listen on {}: {}; choose another --listen", textOf(at), error.message());
    spawn(io_, [self = shared_from_this()] { return self->accept(); });
    return acceptor_.local_endpoint().port();
  }

  void stop() {
    NetError ignored;
    stopped_ = true;
    acceptor_.close(ignored);
    for (const auto& stranger : strangers_) stranger->socket->close();
    events_ = {};
  }

 private:
  asio::awaitable<void> accept();
  asio::awaitable<void> shakeHands(std::shared_ptr<Stranger> stranger);
  void makeRoom();

  asio::io_context& io_;
  tcp::acceptor acceptor_;
  const std::shared_ptr<const TlsContext> tls_;
  Listener::Events events_;
  const ConnectionOptions options_;
  LineLimiter refusals_;
  std::list<std::shared_ptr<Stranger>> strangers_;  // oldest first
  bool stopped_ = false;
};

asio::awaitable<void> Door::accept() {
  while (!stopped_) {
    NetError error;
    tcp::socket socket =
        co_await acceptor_.async_accept(asio::redirect_error(asio::use_awaitable, error));
    if (stopped_) co_return;
    if (error) {  // out of descriptors: others will close
      asio::steady_timer pause(io_, std::chrono::milliseconds(100));
      co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, error));
      continue;
    }
    makeRoom();
    auto stranger = std::make_shared<Stranger>();
    stranger->socket = std::make_shared<SecureSocket>(std::move(socket), tls_);
    strangers_.push_back(stranger);
    spawn(io_, [self = shared_from_this(), stranger] { return self->shakeHands(stranger); });
  }
}

// Whoever floods us pushes out its own oldest connection; a client of ours needs a millisecond.
void Door::makeRoom() {
  while (strangers_.size() >= options_.pendingConnections) {
    strangers_.front()->dropped = "too many others wait to show their key";
    strangers_.front()->socket->close();
    strangers_.pop_front();
  }
}

asio::awaitable<void> Door::shakeHands(std::shared_ptr<Stranger> stranger) {
  std::string why;
  {
    const Deadline deadline(io_, options_.handshake, [stranger, limit = options_.handshake] {
      stranger->dropped = fmt::format("it did not show its key within {:.1f} s", seconds(limit));
      stranger->socket->close();
    });
    try {
      co_await stranger->socket->handshake();
    } catch (const Error& error) {
      why = error.what();
    }
  }
  strangers_.remove(stranger);
  if (stopped_) co_return;
  if (!stranger->dropped.empty()) why = stranger->dropped;
  if (!why.empty()) {
    stranger->socket->close();
    const std::string line = fmt::format("refused {}: {}", stranger->socket->peer(), why);
    if (const auto said = refusals_.admit(line, Clock::now())) events_.onRefused(*said);
    co_return;
  }
  events_.onConnection(
      std::make_shared<TcpConnection>(io_, stranger->socket, Peer::client, options_));
}

class TcpListener : public Listener {
 public:
  TcpListener(std::shared_ptr<Door> door, Endpoint at)
      : door_(std::move(door)), at_(std::move(at)) {}
  ~TcpListener() override { door_->stop(); }
  const Endpoint& endpoint() const override { return at_; }

 private:
  const std::shared_ptr<Door> door_;
  const Endpoint at_;
};

}  // namespace

std::unique_ptr<Listener> Listener::open(EventLoop& loop, const Endpoint& at, Keys keys,
                                         Events events, ConnectionOptions options) {
  NINEFOLD_CHECK(keys.local != nullptr);
  NetError error;
  const auto address =
      asio::ip::make_address(at.host == "localhost" ? "127.0.0.1" : at.host, error);
  if (error) fail("cannot listen on {}: not an IP address of this machine", at.host);
  if (!address.is_loopback() && keys.cluster == nullptr)
    fail("listening on {} lets other machines in: add --key-file (--new-key makes one)", at.host);
  auto door = std::make_shared<Door>(loop.impl().io, std::move(keys), std::move(events), options);
  const uint16_t port = door->open({address, at.port});
  return std::make_unique<TcpListener>(std::move(door), Endpoint{at.host, port});
}

}  // namespace ninefold
