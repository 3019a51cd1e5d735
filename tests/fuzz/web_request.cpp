// Any bytes as a request to the web server: an answer, or a parser's error.
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/parser.hpp>

#include "common/base/check.h"
#include "master/web/web_http.h"
#include "tests/fuzz/fuzz.h"

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  std::vector<std::vector<uint8_t>> seeds;
  for (const std::string_view text :
       {"GET / HTTP/1.1\r\nHost: 127.0.0.1:80\r\n\r\n",
        "GET /metrics HTTP/1.1\r\nHost: [::1]\r\nAuthorization: Bearer abc\r\n\r\n",
        "HEAD / HTTP/1.0\r\nHost: localhost\r\nOrigin: http://localhost\r\n\r\n",
        "GET /live HTTP/1.1\r\nHost: a.b:1\r\nUpgrade: websocket\r\nConnection: upgrade\r\n"
        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n\r\n"})
    seeds.emplace_back(text.begin(), text.end());
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  http::request_parser<http::empty_body> parser;
  parser.header_limit(16 << 10);
  boost::system::error_code error;
  parser.put(boost::asio::buffer(data, size), error);
  if (error || !parser.is_header_done()) return 0;
  const std::string metrics = "metrics";
  const WebSite site{{true, {"*.example.org"}}, "abc", &metrics};
  const WebRequest request = parser.release();
  const WebResponse response = answerTo(request, site);
  const bool isRefused = refusalOf(request, site.identity).has_value();
  NINEFOLD_CHECK(isRefused == (response.result() == http::status::forbidden));
  if (response.body() == metrics)
    NINEFOLD_CHECK(request[http::field::authorization] == "Bearer abc");
  return 0;
}
