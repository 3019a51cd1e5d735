#include "master/running/invitation.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <memory>

#include "common/base/log.h"
#include "common/base/written_file.h"
#include "master/serving/host_clients.h"

namespace ninefold {
namespace {

std::string text(const in_addr& address) {
  char out[INET_ADDRSTRLEN] = {};
  return ::inet_ntop(AF_INET, &address, out, sizeof out);
}
std::string text(const in6_addr& address) {
  char out[INET6_ADDRSTRLEN] = {};
  return ::inet_ntop(AF_INET6, &address, out, sizeof out);
}

bool isOutside(const ifaddrs& interface) {
  return interface.ifa_addr != nullptr && (interface.ifa_flags & IFF_UP) != 0 &&
         (interface.ifa_flags & IFF_LOOPBACK) == 0;
}

}  // namespace

std::vector<std::string> addressesBehind(const std::string& anyAddress) {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, ::freeifaddrs);
  std::vector<std::string> v4, v6;
  for (const ifaddrs* i = all.get(); i != nullptr; i = i->ifa_next) {
    if (!isOutside(*i)) continue;
    if (i->ifa_addr->sa_family == AF_INET)
      v4.push_back(text(reinterpret_cast<const sockaddr_in*>(i->ifa_addr)->sin_addr));
    if (i->ifa_addr->sa_family != AF_INET6 || anyAddress != "::") continue;
    const in6_addr& address = reinterpret_cast<const sockaddr_in6*>(i->ifa_addr)->sin6_addr;
    if (!IN6_IS_ADDR_LINKLOCAL(&address)) v6.push_back(text(address));
  }
  v4.insert(v4.end(), v6.begin(), v6.end());
  return v4;
}

std::vector<std::string> invitation(const Options& options, const Endpoint& at,
                                    const std::vector<std::string>& addresses) {
  std::vector<std::string> lines = {"listening on " + addressText(at)};
  if (!options.keyFile) return lines;
  const auto command = [&](const std::string& host) {
    return fmt::format("ninefold-client --master {} --key-file {}", addressText({host, at.port}),
                       *options.keyFile);
  };
  if (isLoopback(at.host)) {
    lines.push_back("more clients may join on this machine: " + command(at.host) +
                    " (--listen 0.0.0.0:4700 lets others in)");
  } else if (!isAnyAddress(at.host)) {
    lines.push_back("more clients may join; with a copy of the key file: " + command(at.host));
  } else if (addresses.empty()) {
    lines.push_back(
        "no network interface is up: no other machine reaches this one; more clients may join on "
        "this machine: " +
        command(at.host == "::" ? "::1" : "127.0.0.1"));
  } else {
    lines.push_back("more clients may join; with a copy of the key file: " +
                    command(addresses.front()));
    for (size_t i = 1; i < addresses.size(); ++i)
      lines.push_back("or, from another network: " + command(addresses[i]));
  }
  return lines;
}

std::vector<Endpoint> reachableAt(const Endpoint& at, const std::vector<std::string>& addresses) {
  if (!isAnyAddress(at.host)) return {at};
  if (addresses.empty()) return {{at.host == "::" ? "::1" : "127.0.0.1", at.port}};
  std::vector<Endpoint> all;
  for (const std::string& address : addresses) all.push_back({address, at.port});
  return all;
}

void checkGuests(const Options& options) {
  if (options.keyFile) return;
  if (options.localClients == 0)
    failUsage("--local-clients 0 needs --key-file FILE, or no client could join");
  if (options.waitClients > options.localClients)
    failUsage(
        "--wait-clients {}: only {} local client(s) are started, and more need --key-file FILE",
        options.waitClients, options.localClients);
}

void invite(const Options& options, const Endpoint& at) {
  const auto addresses =
      isAnyAddress(at.host) ? addressesBehind(at.host) : std::vector<std::string>();
  for (const std::string& line : invitation(options, at, addresses)) logLine(line);
  if (!options.addressFile) return;
  std::string lines;
  for (const Endpoint& one : reachableAt(at, addresses)) lines += addressText(one) + "\n";
  writeFile(*options.addressFile, lines);
}

}  // namespace ninefold
