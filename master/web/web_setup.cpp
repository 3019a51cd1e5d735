#include "master/web/web_setup.h"

#include <unistd.h>

#include <array>

#include "master/running/invitation.h"

namespace ninefold {
namespace {

std::string ownName() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// By which browsers may call us.
std::vector<std::string> namesAt(const std::string& host) {
  std::vector<std::string> names;
  if (const std::string own = ownName(); !own.empty()) names.push_back(own);
  if (!isAddress(host)) names.push_back(host);
  return names;
}

std::vector<std::string> withAddresses(std::vector<std::string> names, const std::string& host) {
  names.insert(names.end(), {"localhost", "127.0.0.1", "::1"});
  if (isAnyAddress(host)) {
    const std::vector<std::string> more = addressesBehind(host);
    names.insert(names.end(), more.begin(), more.end());
  } else if (isAddress(host)) {
    names.push_back(host);
  }
  return names;
}

}  // namespace

WebSetup webSetup(const Options& options) {
  WebSetup setup;
  setup.listen = parseEndpoint(*options.serve, "--serve");
  const std::string& host = setup.listen.host;
  const bool isOpen = !isLoopback(host);
  // On loopback our own name would be of use only to who has it lead there.
  if (isOpen) setup.identity.names = namesAt(host);
  if (options.serveCertificate)
    setup.tls = loadWebTls(*options.serveCertificate, *options.serveKey);
  else if (isOpen)
    setup.tls = makeWebTls(withAddresses(setup.identity.names, host));
  setup.token = newToken();
  setup.identity.isSecure = setup.tls != nullptr;
  if (options.serveCertificate)
    setup.identity.names.insert(setup.identity.names.end(), setup.tls->names.begin(),
                                setup.tls->names.end());
  return setup;
}

std::vector<std::string> webInvitation(const Options& options, const WebSetup& setup, uint16_t port,
                                       const std::vector<std::string>& addresses) {
  const std::string& host = setup.listen.host;
  std::vector<std::string> hosts = isAnyAddress(host) ? addresses : std::vector{host};
  if (hosts.empty()) hosts = {"127.0.0.1"};  // no interface is up
  std::vector<std::string> lines;
  for (const std::string& at : hosts)
    lines.push_back(fmt::format("{} {}://{}/#token={}", lines.empty() ? "serving at" : "or at",
                                setup.tls ? "https" : "http", addressText({at, port}),
                                setup.token));
  if (setup.tls && !options.serveCertificate)
    lines.push_back(
        "browsers will warn of the certificate, which was made for this run; its SHA-256 is " +
        setup.tls->fingerprint);
  return lines;
}

}  // namespace ninefold
