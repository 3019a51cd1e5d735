#include "master/web/web_server.h"

#include <openssl/ssl.h>

#include <thread>

#include "common/base/log.h"
#include "master/web/web_talk.h"

namespace ninefold {
namespace {

constexpr size_t kMostConnections = 64;
constexpr int kMostRequests = 1000;         // of one connection
constexpr uint32_t kMostHeader = 16 << 10;  // of a request [bytes]
constexpr Duration kTlsWithin = std::chrono::seconds(10);
constexpr Duration kRequestWithin = std::chrono::seconds(10);

using PlainStream = beast::tcp_stream;
using TlsStream = asio::ssl::stream<beast::tcp_stream>;

std::string peerOf(const tcp::socket& socket) {
  NetError error;
  const tcp::endpoint peer = socket.remote_endpoint(error);
  return error ? "an unknown address" : addressText({peer.address().to_string(), peer.port()});
}

// The other side has gone, or has nothing to say: nobody's fault.
bool isGoodbye(const NetError& error) {
  return error == websocket::error::closed || error == http::error::end_of_stream ||
         error == http::error::partial_message || error == beast::error::timeout ||
         error == asio::error::eof || error == asio::error::connection_reset ||
         error == asio::error::broken_pipe || error == asio::error::operation_aborted ||
         error == asio::error::bad_descriptor || error == asio::ssl::error::stream_truncated;
}

// What a peer did wrong, in words for the log.
std::string reasonOf(const NetError& error) {
  const auto code = static_cast<unsigned>(error.value());
  const bool isTls = error.category() == asio::error::get_ssl_category();
  if (isTls && ERR_GET_LIB(code) == ERR_LIB_SSL && ERR_GET_REASON(code) == SSL_R_HTTP_REQUEST)
    return "speaks HTTP, and here is TLS; its address must begin with https://";
  return error.message();
}

void close(PlainStream& stream) { stream.close(); }
void close(TlsStream& stream) { stream.next_layer().close(); }

// Among the desk's open conversations while it lives.
class Listed {
 public:
  Listed(WebDesk& desk, WebDesk::Open open)
      : desk_(desk), at_(desk.open.insert(desk.open.end(), std::move(open))) {}
  ~Listed() { desk_.open.erase(at_); }
  Listed(const Listed&) = delete;
  Listed& operator=(const Listed&) = delete;

 private:
  WebDesk& desk_;
  std::list<WebDesk::Open>::iterator at_;
};

template <typename Stream>
asio::awaitable<void> talk(WebDesk& desk, Stream& stream, WebRequest request) {
  const auto talk = std::make_shared<WebTalk<Stream>>(desk, std::move(stream));
  const Listed listed(desk, {[talk] { talk->close(); }, [talk] { talk->wake(); }});
  co_await talk->run(std::move(request));
}

// One request. True if another may follow.
template <typename Stream>
asio::awaitable<bool> serveOne(WebDesk& desk, Stream& stream, beast::flat_buffer& buffer) {
  http::request_parser<http::empty_body> parser;
  parser.header_limit(kMostHeader);
  {
    const Listed listed(desk, {[&stream] { close(stream); }, nullptr});
    beast::get_lowest_layer(stream).expires_after(kRequestWithin);
    co_await http::async_read(stream, buffer, parser, asio::use_awaitable);
  }
  WebRequest request = parser.release();
  const bool isLive = websocket::is_upgrade(request) && request.target() == kLivePath;
  if (isLive && !refusalOf(request, desk.setup.identity)) {
    co_await talk(desk, stream, std::move(request));
    co_return false;
  }
  const WebSite site{desk.setup.identity, desk.setup.token, &desk.hub.offered().metrics};
  if (const auto why = refusalOf(request, site))
    desk.refuse(peerOf(beast::get_lowest_layer(stream).socket()), *why);
  const WebResponse response = answerTo(request, site);
  const Listed listed(desk, {[&stream] { close(stream); }, nullptr});
  desk.bytesSent += co_await http::async_write(stream, response, asio::use_awaitable);
  co_return response.keep_alive();
}

template <typename Stream>
asio::awaitable<void> serve(WebDesk& desk, Stream& stream) {
  beast::flat_buffer buffer(kMostHeader);
  for (int i = 0; i < kMostRequests; ++i)
    if (!co_await serveOne(desk, stream, buffer)) co_return;
}

asio::awaitable<void> shakeHands(WebDesk& desk, TlsStream& stream) {
  const Listed listed(desk, {[&stream] { close(stream); }, nullptr});
  beast::get_lowest_layer(stream).expires_after(kTlsWithin);
  co_await stream.async_handshake(asio::ssl::stream_base::server, asio::use_awaitable);
}

asio::awaitable<void> serveSocket(WebDesk& desk, tcp::socket socket) {
  if (desk.setup.tls == nullptr) {
    PlainStream stream(std::move(socket));
    co_await serve(desk, stream);
    co_return;
  }
  TlsStream stream(PlainStream(std::move(socket)), desk.setup.tls->context);
  co_await shakeHands(desk, stream);
  co_await serve(desk, stream);
}

}  // namespace

struct WebServer::Impl {
  explicit Impl(WebSetup setup) : desk(std::move(setup)), acceptor(desk.io) {}

  void listen() {
    NetError error;
    const Endpoint& at = desk.setup.listen;
    tcp::resolver resolver(desk.io);
    const auto found = resolver.resolve(at.host, std::to_string(at.port), error);
    if (!error) acceptor.open(found->endpoint().protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(*found, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error)
      fail("cannot serve at {}: {}; choose another --serve", addressText(at), error.message());
    spawn(desk.io, [this] { return accept(); });
  }

  asio::awaitable<void> accept() {
    while (acceptor.is_open()) {
      NetError error;
      tcp::socket socket =
          co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, error));
      if (!error && connections >= kMostConnections) {
        desk.refuse(peerOf(socket), "too many connections");
      } else if (!error) {
        spawn(desk.io, [this, taken = std::make_shared<tcp::socket>(std::move(socket))] {
          return converse(taken);
        });
      } else if (acceptor.is_open()) {  // out of descriptors: others will close
        asio::steady_timer pause(desk.io, std::chrono::milliseconds(100));
        co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, error));
      }
    }
  }

  asio::awaitable<void> converse(std::shared_ptr<tcp::socket> socket) {
    const std::string peer = peerOf(*socket);
    ++connections;
    try {
      co_await serveSocket(desk, std::move(*socket));
    } catch (const Error& error) {
      desk.refuse(peer, error.what());
    } catch (const boost::system::system_error& error) {
      if (!isGoodbye(error.code())) desk.refuse(peer, reasonOf(error.code()));
    } catch (const std::exception& error) {  // out of memory
      desk.refuse(peer, error.what());
    }
    --connections;
  }

  // Every conversation ends with its socket; then run() has nothing left to do.
  void stop() {
    NetError ignored;
    acceptor.close(ignored);
    for (const WebDesk::Open& one : desk.open) one.close();
  }

  WebDesk desk;
  tcp::acceptor acceptor;
  size_t connections = 0;
  std::thread thread;
};

WebServer::WebServer(WebSetup setup) : impl_(std::make_unique<Impl>(std::move(setup))) {
  impl_->listen();
  impl_->thread = std::thread([impl = impl_.get()] {
    pthread_setname_np(pthread_self(), "browsers");  // as top shows it
    impl->desk.io.run();
  });
}

WebServer::~WebServer() {
  asio::post(impl_->desk.io, [impl = impl_.get()] { impl->stop(); });
  impl_->thread.join();
}

uint16_t WebServer::port() const { return impl_->acceptor.local_endpoint().port(); }

std::vector<FromViewer> WebServer::take(Duration most) {
  WebDesk& desk = impl_->desk;
  std::unique_lock lock(desk.mutex);
  desk.arrived.wait_for(lock, most, [&] { return desk.woken || !desk.inbox.empty(); });
  desk.woken = false;
  std::vector<FromViewer> all(desk.inbox.begin(), desk.inbox.end());
  desk.inbox.clear();
  return all;
}

void WebServer::wake() {
  const std::lock_guard lock(impl_->desk.mutex);
  impl_->desk.woken = true;
  impl_->desk.arrived.notify_one();
}

void WebServer::offer(WebOffer offer) {
  asio::post(impl_->desk.io, [&desk = impl_->desk, offer = std::move(offer)]() mutable {
    desk.hub.offer(std::move(offer));
    desk.wakeAll();
  });
}

void WebServer::send(ViewerId viewer, std::shared_ptr<const WebBody> file) {
  asio::post(impl_->desk.io, [&desk = impl_->desk, viewer, file = std::move(file)]() mutable {
    desk.hub.send(viewer, std::move(file));
    desk.wakeAll();
  });
}

WebCounts WebServer::counts() const {
  const WebDesk& desk = impl_->desk;
  return {desk.viewers, desk.refused, desk.bytesSent};
}

}  // namespace ninefold
