// group_paths.h: where some corrective photons of a group go, for a figure.
// Threads: pure function.   Errors: none.
#pragma once

#include <nlohmann/json.hpp>

#include "common/gi/light/light_path.h"
#include "common/gi/selective/photon_groups.h"
#include "common/sampling/halton.h"

namespace ninefold {

// Polylines [m], from the lamp to the second surface that is met: up to 40 of them. Lamps are taken
// for being in air. group: below groups.groups().
inline nlohmann::ordered_json groupPaths(const Transport& t, const PhotonGroups& groups,
                                         uint32_t group) {
  constexpr uint32_t kMost = 40;
  nlohmann::ordered_json paths = nlohmann::ordered_json::array();
  const HaltonSampler numbers(LightStreams::seedOf(0, t.settings.seed), SampleUse::groupPhoton, 0);
  const auto point = [](Vec3 p) { return nlohmann::ordered_json{p.x, p.y, p.z}; };
  for (uint32_t k = 0; k < std::min(groups.photonsOf(group), kMost); ++k) {
    const uint32_t photon = groups.photon(group, k);
    const Particle start = emitAlike(t, 0, numbers.lampAndDirection(photon), numbers.place(photon));
    nlohmann::ordered_json path = nlohmann::ordered_json::array({point(start.origin)});
    RayCounts rays;
    walkLightPath(t, start, MediumStack(), 0, numbers, photon, HaltonSampler::kWalkDimension, rays,
                  [&](const Arrival& a) {
                    if (path.size() < 3) path.push_back(point(a.point->surface.position));
                    return path.size() < 3;
                  });
    paths.push_back(path);
  }
  return paths;
}

}  // namespace ninefold
