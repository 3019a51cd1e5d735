#include "common/gi/bidirectional/raw_light.h"

#include "common/gi/light/light_path.h"

namespace ninefold {
namespace {

// A VPL's D part and its glossy part are of different counts.
void addTo(std::vector<LightSet>& byCount, const VplSet& all, const Vpl& vpl) {
  const auto put = [&](int before, Vpl part) {
    if (before >= static_cast<int>(byCount.size())) return;
    LightSet& set = byCount[static_cast<size_t>(before)];
    if (part.glossy >= 0) {
      set.glossy.push_back(all.glossy[static_cast<size_t>(part.glossy)]);
      part.glossy = static_cast<int>(set.glossy.size()) - 1;
    }
    set.vpls.push_back(part);
  };
  Vpl diffuse = vpl, glossy = vpl;
  diffuse.glossy = -1, glossy.power = Vec3(0);
  if (!isBlack(vpl.power)) put(vpl.diffuseCount, diffuse);
  if (vpl.glossy >= 0) put(vpl.leastCount(), glossy);
}

std::vector<LightSet> splitByCount(const LightSet& raw, int counts) {
  std::vector<LightSet> byCount(static_cast<size_t>(counts));
  for (const Vpl& vpl : raw.vpls) addTo(byCount, raw, vpl);
  for (size_t before = 0; before < byCount.size(); ++before)
    for (size_t kind = 0; kind < kPhotonKinds; ++kind) {
      const PhotonGrid& all = raw.photons[kind];
      if (all.empty()) continue;
      std::vector<Photon> some;
      for (const Photon& photon : all.photons())
        if (photon.diffuseBefore == static_cast<int>(before)) some.push_back(photon);
      byCount[before].photons[kind] = PhotonGrid(std::move(some), all.radius());
    }
  return byCount;
}

}  // namespace

RawLight::RawLight(const Transport& t, LightSet raw) : t_(t), raw_(std::move(raw)) {
  if (t.settings.pathLength > 1) byCount_ = splitByCount(raw_, t.settings.pathLength - 1);
}

void RawLight::gather(int c, const ReceiverSamples& samples, LightSetScratch& scratch,
                      Receivers& receivers, RayCounts& rays) const {
  if (byCount_.empty())
    gatherLightSet(t_, raw_, samples, kReverseLevel, scratch, receivers, nullptr, rays);
  else
    gatherAt(kReverseLevel, c, samples, scratch, receivers, rays);
}

void RawLight::gatherAt(int level, int c, const ReceiverSamples& samples, LightSetScratch& scratch,
                        Receivers& receivers, RayCounts& rays) const {
  const LightSet& set = byCount_[static_cast<size_t>(c - 1)];
  receivers.pad();
  gatherVpls(t_, set, samples, level, t_.settings.vplRoulette, scratch.vplGather, receivers,
             rays.shadow);
  for (const PhotonGrid& grid : set.photons) gatherPhotons(t_, grid, level, receivers, nullptr);
  if (!t_.settings.compensate) return;
  compensate(t_, samples, level, {.emission = c == 1, .onward = c > 1}, scratch.compensation,
             receivers, rays, [&](int next, Receivers& points) {
               gatherAt(next, c - 1, samples, scratch, points, rays);
             });
}

}  // namespace ninefold
