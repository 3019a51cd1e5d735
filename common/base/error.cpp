#include "common/base/error.h"

#include <cstdio>
#include <cstdlib>

namespace ninefold {

void checkFailed(const char* expression, const char* file, int line) {
  std::fprintf(stderr, "internal error: %s does not hold at %s:%d; please report this line\n",
               expression, file, line);
  std::abort();
}

}  // namespace ninefold
