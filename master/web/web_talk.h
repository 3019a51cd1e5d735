// web_talk.h: one viewer's WebSocket: hello, then messages in and updates out. Internal to the
// server.
// Threads: the server's.   Owner: its two coroutines.
// Errors: run() throws Error and system_error; before, the viewer is told why.
#pragma once

#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>

#include "common/base/log.h"
#include "master/web/web_desk.h"
#include "master/web/web_http.h"
#include "proto/deadline.h"

namespace ninefold {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

template <typename Stream>
class WebTalk : public std::enable_shared_from_this<WebTalk<Stream>> {
 public:
  WebTalk(WebDesk& desk, Stream stream) : desk_(desk), socket_(std::move(stream)), wake_(desk.io) {}

  asio::awaitable<void> run(WebRequest request) {
    co_await accept(std::move(request));
    std::optional<std::string> fault;
    try {
      co_await greet();
      id_ = desk_.hub.join(Clock::now());
      desk_.viewers = desk_.hub.viewers();
      log("browser {} looks on", *id_);
      desk_.passOn();
      spawn(desk_.io, [self = this->shared_from_this()] { return self->write(); });
      co_await read();
    } catch (const Error& error) {
      fault = error.what();
    } catch (const boost::system::system_error& error) {
      if (fault_.empty()) {
        leave();
        throw;
      }
      fault = fault_;
    }
    leave();
    co_await sayWhy(*fault);
    throw Error(*fault);
  }

  void close() {
    isOpen_ = false;
    wake_.cancel();
    beast::get_lowest_layer(socket_).close();
  }
  void wake() { wake_.cancel(); }

 private:
  static constexpr Duration kHelloWithin = std::chrono::seconds(5);
  static constexpr size_t kFragment = 64 << 10;        // of a message [bytes]
  static constexpr Duration kLook = milliseconds(50);  // at deadlines and dues

  asio::awaitable<void> accept(WebRequest request) {
    websocket::stream_base::timeout times{};
    times.handshake_timeout = std::chrono::seconds(5);
    times.idle_timeout = std::chrono::seconds(30);
    times.keep_alive_pings = true;
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(times);
    socket_.read_message_max(kLongestViewerMessage);
    socket_.binary(true);
    socket_.write_buffer_bytes(kFragment);  // pings go between fragments of a large file
    co_await socket_.async_accept(request, asio::use_awaitable);
  }

  asio::awaitable<void> greet() {
    Deadline deadline(desk_.io, kHelloWithin, [this] {
      fault_ = "no hello within 5 s";
      close();
    });
    const std::string line = co_await nextLine();
    const ViewerMessage first = parseViewerMessage(line);
    const auto* hello = std::get_if<said::Hello>(&first);
    if (hello == nullptr) fail("the first message is no hello");
    if (!isRightToken(hello->token, desk_.setup.token))
      fail("wrong token; open the address that the master has printed");
  }

  asio::awaitable<std::string> nextLine() {
    beast::flat_buffer buffer(kLongestViewerMessage);
    co_await socket_.async_read(buffer, asio::use_awaitable);
    if (!socket_.got_text()) fail("a message is not text");
    co_return beast::buffers_to_string(buffer.data());
  }

  asio::awaitable<void> read() {
    while (true) {
      const std::string line = co_await nextLine();
      desk_.hub.hear(*id_, parseViewerMessage(line), Clock::now());
      desk_.passOn();
      desk_.wakeAll();  // control may have gone from one to another
    }
  }

  // Ends itself only by closing the socket, which ends read(), too.
  asio::awaitable<void> write() {
    try {
      while (isOpen_) {
        const Time now = Clock::now();
        if (desk_.hub.isLate(*id_, now)) fail("an update was not shown within 30 s");
        if (const auto update = desk_.hub.next(*id_, now)) {
          co_await send(*update);
          if (isOpen_) desk_.hub.written(*id_, Clock::now());
        } else {
          NetError ignored;
          wake_.expires_after(kLook);
          co_await wake_.async_wait(asio::redirect_error(asio::use_awaitable, ignored));
        }
      }
    } catch (const boost::system::system_error&) {
      close();
    } catch (const std::exception& error) {
      fault_ = error.what();
      close();
    }
  }

  asio::awaitable<void> send(const WebUpdate& update) {
    const auto headSize = static_cast<uint32_t>(update.head.size());
    const std::array<asio::const_buffer, 3> parts{
        asio::buffer(&headSize, sizeof headSize), asio::buffer(update.head),
        update.body ? asio::buffer(update.body->bytes) : asio::const_buffer()};
    desk_.bytesSent += co_await socket_.async_write(parts, asio::use_awaitable);
  }

  void leave() {
    isOpen_ = false;
    wake_.cancel();
    if (!id_) return;
    log("browser {} has left", *id_);
    desk_.hub.leave(*std::exchange(id_, {}));
    desk_.viewers = desk_.hub.viewers();
    try {
      desk_.passOn();
    } catch (const Error&) {  // the session is behind; it will hear of it
    }
    desk_.wakeAll();
  }

  // As far as the socket is still open, and nothing is being written.
  asio::awaitable<void> sayWhy(std::string why) {
    NetError ignored;
    why.resize(std::min<size_t>(why.size(), 120));
    const websocket::close_reason reason(websocket::close_code::policy_error, why);
    co_await socket_.async_close(reason, asio::redirect_error(asio::use_awaitable, ignored));
  }

  WebDesk& desk_;
  websocket::stream<Stream> socket_;
  asio::steady_timer wake_;
  std::optional<ViewerId> id_;  // once it looks on
  bool isOpen_ = true;
  std::string fault_;  // why we have closed it ourselves
};

}  // namespace ninefold
