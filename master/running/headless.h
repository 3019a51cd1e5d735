// headless.h: a run without a window: opens frames until the stop rule is met, sums them up on the
// film, writes picture and statistics.
//
//   main thread: film, progress, files      network thread: cluster.h      decoders: assembly.h
//
// Errors: throws Error for what the user must know; whatever frames were complete are written
// before.
#pragma once

#include "master/options/options.h"

namespace ninefold {

// The exit status: 0 done, 128 + N after signal N (cluster.h).
int runHeadless(const Options& options);

}  // namespace ninefold
