// invitation.h: the lines that say where the master listens, and what to type on other machines.
// Errors: UsageError if nobody at all could join.
#pragma once

#include "master/options.h"
#include "proto/connection.h"

namespace ninefold {

// What to type on another machine; nothing if the master hears only this one.
std::optional<std::string> clientCommand(const Options& options, const Endpoint& at,
                                         const std::string& machine);

void invite(const Options& options, const Endpoint& at);

}  // namespace ninefold
