#include "master/web/web_access.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <openssl/crypto.h>

#include <algorithm>

namespace ninefold {
namespace {

// Without port and brackets.
std::string nameOfHost(std::string_view host) {
  if (host.starts_with('[')) return std::string(host.substr(1, host.find(']') - 1));
  return std::string(host.substr(0, host.find(':')));
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool isSame(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower, lower);
}

bool matches(std::string_view name, std::string_view pattern) {
  if (!pattern.starts_with("*.")) return isSame(name, pattern);
  const size_t dot = name.find('.');
  return dot != 0 && dot != std::string_view::npos && isSame(name.substr(dot), pattern.substr(1));
}

}  // namespace

bool isAddress(const std::string& text) {
  in6_addr ignored{};
  return ::inet_pton(AF_INET, text.c_str(), &ignored) == 1 ||
         ::inet_pton(AF_INET6, text.c_str(), &ignored) == 1;
}

bool isOurHost(std::string_view host, const WebIdentity& identity) {
  const std::string name = nameOfHost(host);
  if (name.empty()) return false;
  return isAddress(name) || isSame(name, "localhost") ||
         std::ranges::any_of(identity.names, [&](const auto& own) { return matches(name, own); });
}

bool isOurOrigin(std::string_view origin, std::string_view host, const WebIdentity& identity) {
  const std::string_view scheme = identity.isSecure ? "https://" : "http://";
  return isSame(origin.substr(0, scheme.size()), scheme) &&
         isSame(origin.substr(scheme.size()), host);
}

std::string newToken() {
  const Key key = Key::random();
  std::string text;
  for (const std::byte b : key.bytes()) text += fmt::format("{:02x}", static_cast<unsigned>(b));
  return text;
}

bool isRightToken(std::string_view given, std::string_view wanted) {
  return given.size() == wanted.size() &&
         CRYPTO_memcmp(given.data(), wanted.data(), given.size()) == 0;
}

std::string_view bearerOf(std::string_view authorization) {
  constexpr std::string_view kBearer = "Bearer ";
  return authorization.starts_with(kBearer) ? authorization.substr(kBearer.size())
                                            : std::string_view();
}

}  // namespace ninefold
