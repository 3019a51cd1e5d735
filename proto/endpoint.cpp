#include <algorithm>
#include <charconv>

#include "proto/connection.h"

namespace ninefold {
namespace {

// "[v6]:port" or "host:port" at its colon; npos if there is none where it must be.
size_t colonOf(std::string_view text) {
  if (!text.starts_with('[')) {
    const size_t colon = text.find(':');
    return colon == text.rfind(':') ? colon : std::string_view::npos;
  }
  const size_t bracket = text.find("]:");
  return bracket == std::string_view::npos ? bracket : bracket + 1;
}

// A name or number of a machine has no blanks, control characters or brackets.
bool isHost(std::string_view host) {
  return !host.empty() && std::ranges::all_of(host, [](char c) {
    return static_cast<unsigned char>(c) > ' ' && c != 127 && c != '[' && c != ']';
  });
}

}  // namespace

Endpoint parseEndpoint(std::string_view text, std::string_view flag) {
  const size_t colon = colonOf(text);
  Endpoint endpoint;
  if (colon != std::string_view::npos) {
    std::string_view host = text.substr(0, colon);
    if (host.starts_with('[')) host = host.substr(1, host.size() - 2);
    const std::string_view port = text.substr(colon + 1);
    const auto parsed = std::from_chars(port.data(), port.data() + port.size(), endpoint.port);
    if (isHost(host) && parsed.ec == std::errc{} && parsed.ptr == port.data() + port.size()) {
      endpoint.host = host;
      return endpoint;
    }
  }
  fail("{} {}: write ADDR:PORT, for example 192.168.1.20:4700 or [fd00::1]:4700", flag, text);
}

std::string addressText(const Endpoint& endpoint) {
  const bool isV6 = endpoint.host.find(':') != std::string::npos;
  return isV6 ? fmt::format("[{}]:{}", endpoint.host, endpoint.port)
              : fmt::format("{}:{}", endpoint.host, endpoint.port);
}

bool isAnyAddress(const std::string& host) { return host == "0.0.0.0" || host == "::"; }

bool isLoopback(const std::string& host) {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

}  // namespace ninefold
