// service.h: what a master is on a LAN by DNS-SD (RFC 6763).
//
//   type    _ninefold._tcp
//   name    the master's machine; Avahi adds a number where two are alike
//   TXT     release=NAME, as --version says it
//
// Nothing else is told: no scene, no key, no picture. It lets nobody in.
#pragma once

#include <string>

#include "proto/connection.h"

namespace ninefold {

inline constexpr const char* kServiceType = "_ninefold._tcp";
inline constexpr const char* kReleaseKey = "release";

struct FoundMaster {
  std::string name, release;  // printable; what a stranger says
  Endpoint at;                // an address, no name
};

}  // namespace ninefold
