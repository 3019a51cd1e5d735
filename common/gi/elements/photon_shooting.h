// photon_shooting.h: one photon from its lamp to its end, and what it leaves in mesh elements.
//
// Photon i carries Phi_i/Z by the numbers of i (sampling/halton.h). A hit is kept if the last turn
// before it was D or a glossy lobe, or if it comes straight from a minor lamp (minor_lamps.h).
// Other light straight from a lamp, and by other S lobes, has other ways (light_set/lamp_light.h).
//
// Lamps that were off when a gesture began have a stream of their own (light/light_streams.h): each
// photon shoots once for each stream.
//
// Units:   flux [W].   Proved: tests/gi/selective_test.cpp.
// Threads: pure functions.   Errors: none.
#pragma once

#include <vector>

#include "common/gi/elements/packed_flux.h"
#include "common/gi/elements/photon_rows.h"
#include "common/gi/elements/surface_numbers.h"
#include "common/gi/light/light_path.h"
#include "common/gi/light/media_around.h"
#include "common/gi/light/minor_lamps.h"
#include "common/sampling/halton.h"

namespace ninefold {

// Of all lamps as they are now, largest component [W]: PhotonRow::lampFlux.
float fluxOfLamps(const Transport& transport);

// One stream of lamps, and its numbers.
struct PhotonStream {
  size_t index;
  HaltonSampler numbers;
};
std::vector<PhotonStream> photonStreams(const Transport& t, SampleUse use, uint32_t randomization);

// Whether elements keep what arrives.
bool isForElements(const Transport& t, const Arrival& a, bool isOfMinorLamp);

// The hit that an arrival leaves; its flux is 0 if that is too small. `share`: 1/Z.
ElementHit elementHit(const Transport& t, const SurfaceNumbers& surfaces, const Arrival& a,
                      float share, uint64_t word);

// How a photon leaves its lamp.
struct PhotonStart {
  Particle particle;
  bool isOfMinorLamp = false;
};
PhotonStart photonStart(const Transport& t, const MinorLamps& minor, const PhotonStream& stream,
                        uint32_t photon);

// Adds the hits of photon `photon`. leave, trace: as walkLightPathBy has them.
// gain(arrival): factor on the flux of its hit.
template <typename Leave, typename Gain, typename Trace = TraceRay>
void shootPhoton(const Transport& t, const SurfaceNumbers& surfaces, const PhotonStart& begin,
                 const PhotonStream& stream, uint32_t photon, float share,
                 std::vector<ElementHit>& hits, RayCounts& rays, const Leave& leave,
                 const Gain& gain, const Trace& trace = {}) {
  const size_t first = hits.size();
  Particle start = begin.particle;
  // A lamp may lie in a solid that its light never leaves.
  const MediumStack media = mediaAround(t, start.origin);
  start.flux *= t.shader.squaredIndex(media);
  walkLightPathBy(
      t, start, media, 0, stream.numbers, photon, HaltonSampler::kWalkDimension, rays,
      [&](const Arrival& a) {
        if (isForElements(t, a, begin.isOfMinorLamp)) {
          const uint64_t word = hashWords(photon, stream.index, hits.size() - first);
          const ElementHit hit = elementHit(t, surfaces, a, share * gain(a), word);
          if (hit.flux != 0) hits.push_back(hit);
        }
        return t.allows(a.diffuseBefore + 2);
      },
      leave, trace);
}

// Every n/room-th of the n hits, which carry as much more.
void thinHits(PhotonRow& row, size_t room, uint64_t word);

}  // namespace ninefold
