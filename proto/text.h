// text.h: texts that travel end up on other people's terminals and in logs: they are printable
// UTF-8 of a bounded length. Senders make theirs so, receivers refuse others.
// Threads: pure functions.
#pragma once

#include <string>
#include <string_view>

namespace ninefold {

// `text` with every control character and every byte that is not UTF-8 replaced by '?', cut
// (between characters) to at most `most` bytes. A text is printable if this changes nothing.
std::string printable(std::string_view text, size_t most);

}  // namespace ninefold
