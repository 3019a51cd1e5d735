#include "common/gi/bidirectional/standard_density.h"

#include "common/gi/photons/photon_radii.h"
#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {
namespace {

constexpr float kRadius = 0.05f;  // of R
constexpr float kNormalCosine = 0.5f;

std::vector<Photon> pilotOf(const Transport& t, int pathsLog2) {
  if (t.emitters.empty() || t.settings.indirectVpls == 0 || !t.allows(2)) return {};
  VplSet set;
  RayCounts rays;
  addPilotVpls(t, pathsLog2, set, rays);
  std::vector<Photon> found;
  for (const Vpl& vpl : set.vpls) found.push_back({vpl.position, vpl.normal, vpl.power, 0});
  return found;
}

}  // namespace

StandardDensity::StandardDensity(const Transport& t, int pathsLog2)
    : pilot_(pilotOf(t, pathsLog2), std::max(kRadius * t.radius, PhotonGrid::kMinRadius)),
      scale_(1 / (kPi * pilot_.radius() * pilot_.radius() * static_cast<float>(1 << pathsLog2))) {}

float StandardDensity::operator()(const Place& y) const {
  int count = 0;
  pilot_.near(y.position, y.position, [&](const Photon& photon) {
    if (glm::dot(photon.normal, y.normal) > kNormalCosine) ++count;
  });
  return scale_ * static_cast<float>(count);
}

}  // namespace ninefold
