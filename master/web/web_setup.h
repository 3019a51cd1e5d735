// web_setup.h: --serve: at which address, with which certificate and token, and what people are
// told of it. A token always: other users of this machine reach loopback, too. TLS beyond loopback,
// and where a certificate is given.
// Errors: Error that names the flag.   Threads: pure but for the key and the token.
// Proved: tests/web/web_setup_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "master/options/options.h"
#include "master/web/web_server.h"

namespace ninefold {

WebSetup webSetup(const Options& options);

// Lines for people: where to look, and the certificate's fingerprint if nobody vouches for it.
// `addresses`: as of addressesBehind, if it listens on all interfaces.
std::vector<std::string> webInvitation(const Options& options, const WebSetup& setup, uint16_t port,
                                       const std::vector<std::string>& addresses);

}  // namespace ninefold
