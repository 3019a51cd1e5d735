// invitation.h: the lines that say where the master listens, and what to type on other machines.
// Errors: checkGuests throws UsageError if too few clients could ever join.
#pragma once

#include "master/options.h"
#include "proto/connection.h"

namespace ninefold {

// What to type on another machine; nothing if the master hears only this one.
std::optional<std::string> clientCommand(const Options& options, const Endpoint& at,
                                         const std::string& machine);

// Whether the clients that the run waits for can come at all.
void checkGuests(const Options& options);

void invite(const Options& options, const Endpoint& at);

}  // namespace ninefold
