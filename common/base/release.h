// release.h: the version of all programs of a cluster; others are refused at the handshake.
#pragma once

#include <string>
#include <string_view>

namespace ninefold {

std::string releaseName();

// What --version prints: "ninefold-master 0.1.0".
std::string versionText(std::string_view program);

}  // namespace ninefold
