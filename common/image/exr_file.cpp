// EXR: a magic number, a version with flags, then headers of attributes: name, type, size, value.
#include <algorithm>
#include <string_view>

#include "common/base/error.h"
#include "common/image/image_formats.h"

namespace ninefold {
namespace {

// The bytes before the next zero from `at` on, which then is behind that.
std::string_view exrName(FileBytes file, size_t& at) {
  const auto rest = file.subspan(at);
  const auto end = std::ranges::find(rest, std::byte(0));
  if (end == rest.end()) fail("truncated: the EXR ends in its header");
  const auto length = static_cast<size_t>(end - rest.begin());
  at += length + 1;
  return {reinterpret_cast<const char*>(rest.data()), length};
}

// Attributes up to an empty name: name, type, size, value.
void checkExrHeader(FileBytes file, size_t& at, ImageLimits limits) {
  constexpr size_t kBox = 4 * 4;
  for (auto name = exrName(file, at); !name.empty(); name = exrName(file, at)) {
    exrName(file, at);
    if (file.size() - at < 4) fail("truncated: the EXR ends in its header");
    const size_t size = littleEndian(file, at, 4);
    at += 4;
    if (size > file.size() - at) fail("truncated: the EXR ends in its attribute {}", name);
    const auto corner = [&](size_t i) {
      return static_cast<int32_t>(littleEndian(file, at + 4 * i, 4));
    };
    if (name == "dataWindow" && size == kBox)
      checkImageSize(
          static_cast<uint64_t>(std::max(int64_t{corner(2)} - corner(0) + 1, int64_t{0})),
          static_cast<uint64_t>(std::max(int64_t{corner(3)} - corner(1) + 1, int64_t{0})),
          file.size(), limits);
    at += size;
  }
}

}  // namespace

// One header, or, with a flag, many that end at an empty one.
void checkExr(FileBytes file, ImageLimits limits) {
  constexpr size_t kVersion = 4, kFirst = 8, kManyParts = 0x1000;
  if (file.size() <= kFirst) fail("truncated: the EXR ends in its header");
  size_t at = kFirst;
  checkExrHeader(file, at, limits);
  if ((littleEndian(file, kVersion, 4) & kManyParts) == 0) return;
  while (at < file.size() && file[at] != std::byte(0)) checkExrHeader(file, at, limits);
}

}  // namespace ninefold
