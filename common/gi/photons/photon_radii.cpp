#include "common/gi/photons/photon_radii.h"

namespace ninefold {
namespace {

// Measured at 8 frames, relMSE with 0.2, 1, 4 and without limit: a pool of water 0.069, 0.058,
// 0.065, 0.44; conference 0.238, 0.238, 0.245, 0.317; table_room, a sharp caustic, 0.029, 0.027,
// 0.027, 0.027.
constexpr float kBrightest = 1;

}  // namespace

PhotonRadii::PhotonRadii(const Transport& t, Metres radius)
    : radius_(radius), first_(t.settings.photonRadius * t.radius) {
  // Fractions of R: their squares stay in range whatever the scene's size.
  for (size_t j = 0; j < kPhotonKinds; ++j) {
    const float part = first(j) / t.radius;
    most_[j] = kBrightest * 0.25f * part * part * t.lampFlux;
  }
}

}  // namespace ninefold
