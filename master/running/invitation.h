// invitation.h: the lines that say where the master listens, and what to type on other machines.
// Errors: checkGuests throws UsageError if too few clients could ever join; invite throws Error if
// the address file cannot be written.
#pragma once

#include <string>
#include <vector>

#include "master/options/options.h"
#include "proto/connection.h"

namespace ninefold {

// Whether the clients that the run waits for can come at all.
void checkGuests(const Options& options);

// Addresses at which others reach a master that listens on all interfaces (0.0.0.0, or :: for IPv6
// as well): those of interfaces that are up, without loopback and link-local IPv6.
std::vector<std::string> addressesBehind(const std::string& anyAddress);

// `addresses`: as of addressesBehind, if `at` is on all interfaces.
std::vector<std::string> invitation(const Options& options, const Endpoint& at,
                                    const std::vector<std::string>& addresses);

// Where a master that listens at `at` is reached; never empty.
std::vector<Endpoint> reachableAt(const Endpoint& at, const std::vector<std::string>& addresses);

// Logs the invitation, and writes --address-file.
void invite(const Options& options, const Endpoint& at);

}  // namespace ninefold
