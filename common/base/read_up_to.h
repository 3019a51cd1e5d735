// read_up_to.h: reading from a file descriptor until there is enough, whatever interrupts it.
// Threads: any. Errors: none thrown; errno says why it is less, if it is not the end.
#pragma once

#include <cstddef>
#include <span>

namespace ninefold {

// Reads until `into` is full or the data end or fail; how many bytes that were.
size_t readUpTo(int fd, std::span<std::byte> into);

}  // namespace ninefold
