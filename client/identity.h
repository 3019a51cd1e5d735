// identity.h: how this process introduces itself to a master: its release, its threads, and its
// pixel class, proved by rendering the probe scene.
// Errors: Error if the instruction set cannot be had on this machine.
// Threads: pure. Takes some ms.
#pragma once

#include "client/options.h"
#include "proto/messages.h"

namespace ninefold::client {

msg::Hello introduce(const Options& options);

}  // namespace ninefold::client
