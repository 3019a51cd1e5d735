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
  LocalClients::Plan local;
  local.program = programBesideUs("ninefold-client");
  local.arguments = {fmt::format("--threads={}", options.clientThreads), "--isa=" + options.isa,
                     "--cache=none"};
  local.key = keys.local;
  local.count = options.localClients;
  ServerSetup server{parseEndpoint(options.listen, "--listen"), keys, options.waitClients};
  const auto patience =
      isWatched(options) ? std::nullopt : std::optional(fromSeconds(options.patience));
  return {std::move(server), std::move(local), keys.cluster != nullptr, patience};
}

}  // namespace ninefold
