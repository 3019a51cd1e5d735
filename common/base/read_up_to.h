// read_up_to.h: reading from a file descriptor until there is enough, whatever interrupts it.
// Threads: any.   Errors: none thrown; errno says why a read failed.
#pragma once

#include <cstddef>
#include <span>

namespace ninefold {

// Reads until `into` is full, the data end, or a read fails. Returns the number of bytes read.
size_t readUpTo(int fd, std::span<std::byte> into);

}  // namespace ninefold
