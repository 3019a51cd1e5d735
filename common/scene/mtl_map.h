// mtl_map.h: what follows a map statement of an MTL file: options, then the name of an image.
//
// -s -o -t     one to three numbers; those that are absent are 1, 0, 0
// -mm          base and gain: a value t of the image counts as base + gain t
// -bm          multiplies a bump map's heights, a normal map's slopes
// -clamp       on or off
// -imfchan     r g b, m (the alpha channel) or l (luminance): the channel of a scalar
// -blendu -blendv -boost -texres -type   how old programs filtered and projected: nothing to us
// -t -cc       turbulence and colour correction are not modelled
//
// Options may also stand behind the name. A name may have blanks, quotes around it, backslashes
// between folders, and may begin with a number. Where a number may belong to an option or to the
// name, the reading whose file exists is taken.
// Threads: pure.   Errors: none; what cannot be read is no option, and so part of the name.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "common/math/vec.h"
#include "common/scene/unread_keys.h"

namespace ninefold {

struct MtlMap {
  std::string file;  // empty = none; folders end in '/'
  Vec2 scale{1}, offset{0};
  float base = 0, gain = 1, bump = 1;
  bool clamp = false;
  char channel = 0;  // r g b m l; 0 = not told
  explicit operator bool() const { return !file.empty(); }
};

using FileExists = std::function<bool(const std::string&)>;

// `rest`: the line behind the map's keyword; `line`: its number. Options that are not modelled go
// to `unread`.
MtlMap parseMtlMap(std::string_view rest, const FileExists& exists, UnreadKeys& unread,
                   uint64_t line);

// Quotes gone, backslashes turned.
std::string fileName(std::string_view text);

}  // namespace ninefold
