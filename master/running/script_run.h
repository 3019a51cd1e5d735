// script_run.h: --script without a window: in real time or picture by picture.
// Errors: throws Error for what the user must know.
#pragma once

#include "master/options/options.h"

namespace ninefold {

// The exit status, as of runHeadless.
int runScript(const Options& options);

}  // namespace ninefold
