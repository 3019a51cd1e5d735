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
  ServerSetup server{parseEndpoint(options.listen, "--listen"), keys, options.waitClients,
                     options.verify, options.settings.seed};
  const auto patience =
      options.window ? std::nullopt : std::optional(fromSeconds(options.patience));
  return {std::move(server), std::move(local), keys.cluster != nullptr, !isLive(options), patience};
}

}  // namespace ninefold
