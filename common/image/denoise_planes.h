// denoise_planes.h: what denoise.h looks at, as planes with a border, so that windows may reach
// over the picture's edge without a question. In the border colours are those of the nearest
// pixel, and trust is 0: nobody takes from there.
//
// A strip of pixels is measured in its full width also where the picture is narrower. It then reads
// on into the next rows, of which the border below has enough; what it finds there is not used.
//
// Threads: plain data.   Errors: none.
#pragma once

#include <vector>

#include "common/image/denoise.h"

namespace ninefold {

struct DenoisePlanes {
  static constexpr int kBorder = 16;  // a window, a patch and two vectors of lanes fit in

  DenoisePlanes(const RgbImage& picture, const std::vector<float>& standardError,
                const DenoiseGuides& guides);

  int width = 0, height = 0;  // of the picture
  int stride = 0;
  RgbPlane color, normal;
  std::vector<float> variance;              // V
  std::vector<float> trust;                 // h; 0 in the border and where colour is not finite
  std::vector<float> albedo, nearness;      // of the guides
  std::vector<float> slopeX, slopeY, perZ;  // of nearness a pixel; 1/(nearness kNearness)

  size_t at(int x, int y) const {
    return pixelCount(stride, y + kBorder) + static_cast<size_t>(x + kBorder);
  }

 private:
  void fillTrust(const std::vector<float>& squaredError);
  void fillSlopes();
};

}  // namespace ninefold
