// BMP: a file header of 14 bytes, then one of the bitmap: its own size, width, height, planes, bits
// a pixel and, if it is not of the oldest kind, how pixels are packed.
#include <cstdlib>

#include "common/base/error.h"
#include "common/image/image_formats.h"

namespace ninefold {

// The library takes memory for all pixels when it opens a file packed by runs. It looks for their
// colours in a table, which true colours do not have.
void checkBmp(FileBytes file, ImageLimits limits) {
  constexpr size_t kInfo = 14, kSize = kInfo + 4, kOldEnd = kInfo + 12, kEnd = kInfo + 20;
  constexpr size_t kOldInfo = 12, kRuns = 1, kShortRuns = 2;
  if (file.size() < kOldEnd) fail("truncated: the BMP ends in its header");
  if (littleEndian(file, kInfo, 4) == kOldInfo)
    return checkImageSize(littleEndian(file, kSize, 2), littleEndian(file, kSize + 2, 2),
                          file.size(), limits);
  if (file.size() < kEnd) fail("truncated: the BMP ends in its header");
  const auto height = static_cast<int32_t>(littleEndian(file, kSize + 4, 4));
  const auto rows = static_cast<uint64_t>(std::abs(int64_t{height}));  // negative: from the top
  checkImageSize(littleEndian(file, kSize, 4), rows, file.size(), limits);
  const size_t bits = littleEndian(file, kSize + 10, 2), packed = littleEndian(file, kSize + 12, 4);
  if ((packed == kRuns && bits != 8) || (packed == kShortRuns && bits != 4))
    fail("damaged: a BMP of {} bits a pixel is packed by runs of {}", bits,
         packed == kRuns ? 8 : 4);
}

}  // namespace ninefold
