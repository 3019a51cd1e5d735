// web_tls.h: TLS 1.3 for browsers, with a certificate of the user's or one made on the spot.
//
// That one is for this run alone: a P-256 key that no file ever holds, signed by itself, for the
// names and addresses that are given. Browsers warn of it; its fingerprint tells that it is ours.
// Threads: made in one, used in another.   Errors: Error that names the flag and the file.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <memory>
#include <string>
#include <vector>

namespace ninefold {

struct WebTls {
  boost::asio::ssl::context context;
  std::string fingerprint;         // SHA-256 of the certificate: "AB:CD:..."
  std::vector<std::string> names;  // DNS names that the certificate is for
};

// PEM files: a chain, and its private key without a password.
std::shared_ptr<WebTls> loadWebTls(const std::string& certificate, const std::string& key);
std::shared_ptr<WebTls> makeWebTls(const std::vector<std::string>& namesAndAddresses);

}  // namespace ninefold
