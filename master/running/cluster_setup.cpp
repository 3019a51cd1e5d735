#include "master/running/cluster_setup.h"

#include <fmt/format.h>

#include "common/base/process.h"

namespace ninefold {

Listener::Keys loadKeys(const Options& options) {
  Listener::Keys keys;
  keys.local = std::make_shared<const Key>(Key::random());
  if (options.keyFile) keys.cluster = std::make_shared<const Key>(Key::load(*options.keyFile));
  return keys;
}

ClusterSetup clusterSetup(const Options& options, const Listener::Keys& keys) {
  StartedClients::Plan local;
  local.program = programBesideUs("ninefold-client");
  local.arguments = {fmt::format("--threads={}", options.clientThreads), "--isa=" + options.isa,
                     "--cache=none"};
  local.key = keys.local;
  for (int i = 1; i <= options.localClients; ++i)
    local.clients.push_back({fmt::format("local{}", i),
                             fmt::format("local client {}", i),
                             {fmt::format("--name=local{}", i),
                              fmt::format("--key-descriptor={}", kInheritedDescriptor)}});
  ServerSetup server{parseEndpoint(options.listen, "--listen"), keys, options.waitClients};
  const auto patience =
      options.window ? std::nullopt : std::optional(fromSeconds(options.patience));
  ClusterSetup setup{std::move(server), std::move(local)};
  if (options.hosts) setup.hosts = readHosts(*options.hosts);
  setup.isa = options.isa;
  setup.remoteMayJoin = keys.cluster != nullptr;
  setup.patience = patience;
  return setup;
}

}  // namespace ninefold
