// web_http.h: what the server answers to a request that is no WebSocket. Pure.
// Threads: pure functions.   Errors: none.   Proved: tests/web/web_http_test.cpp.
#pragma once

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <optional>
#include <string>

#include "master/web/web_access.h"

namespace ninefold {

namespace http = boost::beast::http;
using WebRequest = http::request<http::empty_body>;
using WebResponse = http::response<http::string_body>;

inline constexpr const char* kLivePath = "/live";  // of the WebSocket

struct WebSite {
  WebIdentity identity;
  std::string token;
  const std::string* metrics = nullptr;
};

// Why a request of any kind gets nothing: wrong host or origin.
std::optional<std::string> refusalOf(const WebRequest& request, const WebIdentity& identity);
// Why a request that is no WebSocket is turned away: as above, or metrics without the token.
// A path that is not there does not count: browsers ask for an icon.
std::optional<std::string> refusalOf(const WebRequest& request, const WebSite& site);

WebResponse answerTo(const WebRequest& request, const WebSite& site);

}  // namespace ninefold
