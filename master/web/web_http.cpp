#include "master/web/web_http.h"

#include "master/web/page.h"

namespace ninefold {
namespace {

using Field = http::field;

constexpr std::string_view kMetricsPath = "/metrics";

std::string_view value(const WebRequest& request, Field field) {
  const auto text = request[field];
  return {text.data(), text.size()};
}

std::string_view targetOf(const WebRequest& request) {
  return {request.target().data(), request.target().size()};
}

WebResponse respond(const WebRequest& request, http::status status, const char* type,
                    std::string body) {
  static const std::string policy = policyOf(kPage);
  WebResponse response(status, request.version());
  response.set(Field::content_type, type);
  response.set(Field::cache_control, "no-store");
  response.set("Content-Security-Policy", policy);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("X-Frame-Options", "DENY");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.keep_alive(request.keep_alive());
  const size_t size = body.size();
  if (request.method() != http::verb::head) response.body() = std::move(body);
  response.content_length(size);
  return response;
}

WebResponse plain(const WebRequest& request, http::status status, const std::string& text) {
  return respond(request, status, "text/plain; charset=utf-8", text + "\n");
}

// Why these metrics are not for who asks.
std::optional<std::string> tokenRefusalOf(const WebRequest& request, const std::string& token) {
  if (targetOf(request) != kMetricsPath) return std::nullopt;
  if (isRightToken(bearerOf(value(request, Field::authorization)), token)) return std::nullopt;
  return "wrong token; send Authorization: Bearer TOKEN, with that of the printed address";
}

}  // namespace

std::optional<std::string> refusalOf(const WebRequest& request, const WebIdentity& identity) {
  const std::string_view host = value(request, Field::host);
  if (request.count(Field::host) != 1 || !isOurHost(host, identity))
    return "this is not the host that the request is for; use the address that was printed";
  if (request.count(Field::origin) == 0) return std::nullopt;
  if (request.count(Field::origin) > 1 ||
      !isOurOrigin(value(request, Field::origin), host, identity))
    return "the page that asks came from somewhere else";
  return std::nullopt;
}

std::optional<std::string> refusalOf(const WebRequest& request, const WebSite& site) {
  if (auto why = refusalOf(request, site.identity)) return why;
  return tokenRefusalOf(request, site.token);
}

WebResponse answerTo(const WebRequest& request, const WebSite& site) {
  if (const auto why = refusalOf(request, site.identity))
    return plain(request, http::status::forbidden, *why);
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return plain(request, http::status::method_not_allowed, "only GET and HEAD");
  const std::string_view target = targetOf(request);
  if (target == "/")
    return respond(request, http::status::ok, "text/html; charset=utf-8", std::string(kPage));
  if (target == kLivePath)
    return plain(request, http::status::upgrade_required, "this is for a WebSocket");
  if (target != kMetricsPath)
    return plain(request, http::status::not_found, "there are / and /metrics");
  if (const auto why = tokenRefusalOf(request, site.token)) {
    WebResponse response = plain(request, http::status::unauthorized, *why);
    response.set(Field::www_authenticate, "Bearer");
    return response;
  }
  return respond(request, http::status::ok, "text/plain; version=0.0.4; charset=utf-8",
                 *site.metrics);
}

}  // namespace ninefold
