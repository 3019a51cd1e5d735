#include "common/base/error.h"

#include <cstdio>
#include <cstdlib>

namespace ninefold {

void checkFailed(const char* expression, const std::string& values, const char* file, int line) {
  const std::string shown = values.empty() ? "" : " (" + values + ")";
  std::fprintf(stderr, "internal error: %s does not hold%s at %s:%d; please report this line\n",
               expression, shown.c_str(), file, line);
  std::abort();
}

}  // namespace ninefold
