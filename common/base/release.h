// release.h: what all programs of a cluster are built from. The handshake refuses others.
//
// The name holds the project's version, the commit, and a digest of what differs from the commit.
// cmake/release.cmake writes it at each build.
#pragma once

#include <string>
#include <string_view>

namespace ninefold {

// "0.1.0+1f0c25aa9b3e"
std::string releaseName();

// What --version prints: "ninefold-master 0.1.0+1f0c25aa9b3e".
std::string versionText(std::string_view program);

}  // namespace ninefold
