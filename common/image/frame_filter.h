// frame_filter.h: from a complete frame buffer to radiance:
//
//   L(p) = sum over layers of reflectance * E' + U        E' = E through the discontinuity buffer
//
// summed in the order of the layers. Only E is filtered, so that textures and highlights stay
// sharp. Use: reset() once per shape; per frame guideRows() for all rows, then composeRows() for
// all rows; or compose(), which does both.
// Threads: rows at once, as in discontinuity_buffer.h. No allocation after reset().
#pragma once

#include <array>

#include "common/image/discontinuity_buffer.h"
#include "common/image/image.h"

namespace ninefold {

class FrameFilter {
 public:
  void reset(const TileGrid& grid, uint8_t layerMask, SurfaceTest test);

  void guideRows(const FrameBuffer& frame, const Camera& camera, int phase, int j0, int j1);
  // Writes the pixels of rows [j0, j1) of a phase into `beauty`, which has the frame's size.
  void composeRows(const FrameBuffer& frame, int phase, int j0, int j1, float neighbourWeight,
                   RgbImage& beauty);
  // The whole frame; sets the shape of `beauty`.
  void compose(const FrameBuffer& frame, const Camera& camera, float neighbourWeight,
               RgbImage& beauty);

  // E' of the diffuse layer after composeRows, in the phase's sub-plane.
  const RgbPlane& irradiance(int phase) const { return filtered_[0][static_cast<size_t>(phase)]; }

 private:
  DiscontinuityBuffer buffer_;
  std::array<std::vector<RgbPlane>, kLayers> filtered_;  // [layer][phase]
};

}  // namespace ninefold
