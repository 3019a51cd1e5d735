// prefetch.h: asks the memory for what will be used soon, where no processor looks ahead by itself.
// Threads: any.   Errors: none; addresses that belong to nobody are passed over.
#pragma once

#include <cstddef>

namespace ninefold {

enum class Soon : int { isRead = 0, isWritten = 1 };

// What is only read may wait in the second cache: it is needed after the work at hand.
template <Soon soon>
void prefetch(const void* from, size_t bytes) {
  constexpr size_t kLine = 64;
  constexpr int kNearness = soon == Soon::isRead ? 2 : 3;
  for (size_t i = 0; i < bytes; i += kLine)
    __builtin_prefetch(static_cast<const std::byte*>(from) + i, static_cast<int>(soon), kNearness);
}

}  // namespace ninefold
