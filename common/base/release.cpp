#include "common/base/release.h"

namespace ninefold {

// In one piece, so that `strings` finds it in a program.
extern const char kReleaseName[];

std::string releaseName() { return kReleaseName; }

std::string versionText(std::string_view program) {
  return std::string(program) + " " + releaseName() + "\n";
}

}  // namespace ninefold
