// patch_filter.h: from a patch to radiance:
//
//   L(p) = sum over layers of reflectance * E' + U        E' = E through the discontinuity buffer
//
// summed in the order of the layers. Only E is filtered, so that textures and highlights stay
// sharp. Threads: one at a time. No allocation after the first patch of a job.
#pragma once

#include "common/image/discontinuity_buffer.h"
#include "common/image/image.h"

namespace ninefold {

class PatchFilter {
 public:
  explicit PatchFilter(SurfaceTest test) : buffer_(test) {}

  // Writes the tile's pixels; sets the shape of `beauty`.
  void compose(const Patch& patch, const Camera& camera, float neighbourWeight, RgbImage& beauty);

  // Whether compose keeps E' of the diffuse layer for who asks; else only if the patch has extra planes,
  // for which it is another.
  void keepIrradiance(bool keep) { keepsIrradiance_ = keep; }
  // E' of the diffuse layer after compose, in the patch's planes; 0 where the layer is dark.
  const RgbPlane& irradiance(int phase) const { return irradiance_[static_cast<size_t>(phase)]; }

  // After compose: into each of the tile's pixels, as grey, what share of the window the diffuse
  // layer's light there is the mean of. U is nobody's but the pixel's; 0 where there is no light.
  void paintShares(const Patch& patch, float neighbourWeight, RgbImage& grey) const;

 private:
  void addLayer(const Patch& patch, int layer, int phase, float neighbourWeight, RgbPlane& sum);

  DiscontinuityBuffer buffer_;
  bool keepsIrradiance_ = false;
  std::vector<RgbPlane> irradiance_;  // of the diffuse layer, by phase
  RgbPlane filtered_;                 // E' of one layer and phase
  std::vector<RgbPlane> radiance_;    // of the phases of one row
};

// One thread's memory for the tiles that it filters.
struct FilterDesk {
  explicit FilterDesk(SurfaceTest test) : filter(test) {}
  Patch patch;
  PatchFilter filter;
  RgbImage beauty;
};

}  // namespace ninefold
