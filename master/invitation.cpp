#include "master/invitation.h"

#include <unistd.h>

#include "common/base/log.h"

namespace ninefold {
namespace {

std::string machineName() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "this-machine";
}

bool isAnyAddress(const std::string& host) { return host == "0.0.0.0" || host == "::"; }

std::string addressText(const std::string& host, uint16_t port) {
  return host.find(':') == std::string::npos ? fmt::format("{}:{}", host, port)
                                             : fmt::format("[{}]:{}", host, port);
}

}  // namespace

std::optional<std::string> clientCommand(const Options& options, const Endpoint& at,
                                         const std::string& machine) {
  if (!options.keyFile) return std::nullopt;
  return fmt::format("ninefold-client --master {} --key-file {}",
                     addressText(isAnyAddress(at.host) ? machine : at.host, at.port),
                     *options.keyFile);
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
  log("listening on {}", addressText(at.host, at.port));
  if (const auto command = clientCommand(options, at, machineName()))
    log("more clients may join; with a copy of the key file: {}", *command);
}

}  // namespace ninefold
