// cluster_setup.h: what the command line says about the cluster, for every kind of run.
// Errors: throws Error (no such program or key, an address that cannot be).
#pragma once

#include "master/options/options.h"
#include "master/serving/cluster.h"

namespace ninefold {

Listener::Keys loadKeys(const Options& options);

ClusterSetup clusterSetup(const Options& options, const Listener::Keys& keys);

}  // namespace ninefold
