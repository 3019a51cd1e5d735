#include "proto/text.h"

#include <cstdint>

namespace ninefold {
namespace {

// Bytes of the character that `text` begins with, if it is well-formed UTF-8 and no control
// character; else 0.
size_t characterBytes(std::string_view text) {
  const auto first = static_cast<uint8_t>(text[0]);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const size_t count = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 0;
  if (count == 0 || count > text.size() || first >= 0xf8) return 0;
  uint32_t code = first & (0x7fu >> count);
  for (size_t i = 1; i < count; ++i) {
    const auto next = static_cast<uint8_t>(text[i]);
    if ((next & 0xc0) != 0x80) return 0;
    code = code << 6 | (next & 0x3fu);
  }
  constexpr uint32_t kLeast[] = {0, 0, 0xa0, 0x800,
                                 0x10000};  // no longer forms; 0x80..0x9f are controls
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code >= kLeast[count] && code <= 0x10ffff && !surrogate ? count : 0;
}

}  // namespace

std::string printable(std::string_view text, size_t most) {
  std::string out;
  while (!text.empty()) {
    const size_t good = characterBytes(text);
    const size_t count = good == 0 ? 1 : good;
    if (out.size() + count > most) break;
    if (good == 0)
      out += '?';
    else
      out += text.substr(0, count);
    text.remove_prefix(count);
  }
  return out;
}

}  // namespace ninefold
