// web_server.h: the thread that talks to browsers: HTTP and WebSocket by Boost.Beast, inside TLS if
// it is given a certificate.
//
//   GET /           the page (page.html)         GET /metrics   metrics.h; "Bearer TOKEN" if there
//   GET /live       the WebSocket: viewer_message.h in, web_offer.h out    is one
//
// The first message of a WebSocket is hello; before it nothing is sent. Each update waits until the
// viewer has said that the one before is shown, so that nothing piles up: the newest comes next.
// Deadlines: TLS, a request, hello, an update that is not shown, silence (pings keep it busy).
// Bounds: connections, viewers, bytes and headers of a request, bytes of a message, messages a
// second, what the session has not taken yet. Who breaks one is turned away, with a line in the
// log; lines are limited, too.
//
// Threads: its own; all functions may be called from any thread.
// Owner: the session; ends and joins when destroyed.
// Errors: the constructor throws Error (cannot listen). Viewers' errors end their connection.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/clock.h"
#include "master/web/viewer_message.h"
#include "master/web/web_access.h"
#include "master/web/web_offer.h"
#include "master/web/web_tls.h"
#include "proto/connection.h"

namespace ninefold {

struct WebSetup {
  Endpoint listen;
  WebIdentity identity;
  std::shared_ptr<WebTls> tls;  // null: none
  std::string token;
};

// Another viewer is in control, or none is: what was held is let go.
struct NewHand {};
struct FromViewer {
  ViewerId viewer = 0;
  std::variant<NewHand, said::Size, said::Event, said::View, said::Exposure, said::Lamp, said::GoTo,
               said::Download>
      what;
};

struct WebCounts {
  uint64_t viewers = 0, refused = 0, bytesSent = 0;
};

class WebServer {
 public:
  explicit WebServer(WebSetup setup);
  ~WebServer();

  uint16_t port() const;

  // What has come, in order: of viewers in control, and downloads of any. Waits until there is
  // something, wake() is called, or the time is over.
  std::vector<FromViewer> take(Duration most);
  void wake();

  void offer(WebOffer offer);  // what is to be seen from now on
  void send(ViewerId viewer, std::shared_ptr<const WebBody> file);
  WebCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ninefold
