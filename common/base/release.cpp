#include "common/base/release.h"

namespace ninefold {

std::string versionText(std::string_view program) {
  return std::string(program) + " " + releaseName() + "\n";
}

}  // namespace ninefold
