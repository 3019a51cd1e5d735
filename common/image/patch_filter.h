// patch_filter.h: from a patch to radiance [W/(m^2 sr)]:
//
//   L(p) = sum over layers of reflectance * E' + U        E' = E through the discontinuity buffer
//
// summed in the order of the layers. Only E is filtered, so textures and highlights stay sharp.
//
// Threads: one at a time.   Memory: no allocation after the first patch of a job.
#pragma once

#include "common/image/discontinuity_buffer.h"
#include "common/image/image.h"

namespace ninefold {

class PatchFilter {
 public:
  explicit PatchFilter(SurfaceTest test) : buffer_(test) {}

  // Writes the tile's pixels; sets the shape of `beauty`. unfiltered: if not null, the same with E
  // for E'.
  void compose(const Patch& patch, const Camera& camera, float neighbourWeight, RgbImage& beauty,
               RgbImage* unfiltered = nullptr);

  // Whether compose keeps E' of the diffuse layer for irradiance().
  void keepIrradiance(bool keep) { keepsIrradiance_ = keep; }
  // E' of the diffuse layer after compose, in the patch's planes; 0 where the layer is dark.
  const RgbPlane& irradiance(int phase) const { return irradiance_[static_cast<size_t>(phase)]; }

  // After compose. Writes to each of the tile's pixels, as grey, the share of the window that the
  // diffuse layer's light there is the mean of; 0 where there is no light. U is the pixel's alone.
  void paintShares(const Patch& patch, float neighbourWeight, RgbImage& grey) const;

 private:
  void addLayer(const Patch& patch, int layer, int phase, float neighbourWeight, RgbPlane& sum,
                RgbPlane* unfiltered);

  DiscontinuityBuffer buffer_;
  bool keepsIrradiance_ = false;
  std::vector<RgbPlane> irradiance_;  // of the diffuse layer, by phase
  RgbPlane filtered_;                 // E' of one layer and phase
  std::vector<RgbPlane> radiance_;    // of the phases of one row
  std::vector<RgbPlane> unfiltered_;  // the same with E
};

// One thread's memory for the tiles that it filters.
struct FilterDesk {
  explicit FilterDesk(SurfaceTest test) : filter(test) {}
  Patch patch;
  PatchFilter filter;
  RgbImage beauty;
  RgbImage unfiltered;  // if the film keeps it, too
};

}  // namespace ninefold
