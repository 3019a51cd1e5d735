#include "common/base/read_up_to.h"

#include <unistd.h>

#include <cerrno>

namespace ninefold {

size_t readUpTo(int fd, std::span<std::byte> into) {
  size_t have = 0;
  while (have < into.size()) {
    const ssize_t got = ::read(fd, into.data() + have, into.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    have += static_cast<size_t>(got);
  }
  return have;
}

}  // namespace ninefold
