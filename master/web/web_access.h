// web_access.h: whom the server talks to. Pure.
//
// Another site's page in a user's browser can send requests here. It cannot choose the Host header,
// which names the site that the browser believes to be at, nor the Origin header, which names the
// page that asks. So both must name us: a Host is an address, a name of this machine, or a name of
// the certificate; an Origin, if there is one, is our scheme and the same Host.
// Who holds no browser and sends no Origin still needs the token.
//
// Threads: plain values.   Errors: none.   Proved: tests/web/web_access_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "proto/key.h"

namespace ninefold {

struct WebIdentity {
  bool isSecure = false;  // TLS
  std::vector<std::string>
      names;  // beside addresses and localhost; "*.x" is any one label before x
};

bool isAddress(const std::string& text);  // 1.2.3.4, ::1

// `host`: "name", "name:port", "1.2.3.4:80", "[::1]:80".
bool isOurHost(std::string_view host, const WebIdentity& identity);
bool isOurOrigin(std::string_view origin, std::string_view host, const WebIdentity& identity);

// 64 hex digits.
std::string newToken();
// In a time that does not depend on where they differ.
bool isRightToken(std::string_view given, std::string_view wanted);
// The token of an Authorization header ("Bearer TOKEN"); empty if it has none.
std::string_view bearerOf(std::string_view authorization);

}  // namespace ninefold
