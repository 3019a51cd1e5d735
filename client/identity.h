// identity.h: how this process introduces itself to a master: its release, its threads, and its
// pixel class, which it finds by rendering the probe scene. That takes some milliseconds.
// Errors: Error if this machine lacks the instruction set.   Threads: pure function.
#pragma once

#include "client/options.h"
#include "proto/messages.h"

namespace ninefold::client {

msg::Hello introduce(const Options& options);

}  // namespace ninefold::client
