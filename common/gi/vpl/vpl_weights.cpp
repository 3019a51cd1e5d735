#include "common/gi/vpl/vpl_weights.h"

namespace ninefold {
namespace {

// Straight-line loops over planar arrays: the compiler turns them into vector code.
void surfaceWeights(const Vpl& vpl, const Receivers& r, size_t first, float* weight) {
  const float bound = vpl.bound;
#pragma GCC ivdep
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    const float dx = vpl.position.x - r.px[i], dy = vpl.position.y - r.py[i],
                dz = vpl.position.z - r.pz[i];
    const float d2 = dx * dx + dy * dy + dz * dz;
    const float cosXd = dx * r.gx[i] + dy * r.gy[i] + dz * r.gz[i];  // cos * d
    const float cosSd = dx * r.sx[i] + dy * r.sy[i] + dz * r.sz[i];
    const float cosYd = -(dx * vpl.normal.x + dy * vpl.normal.y + dz * vpl.normal.z);
    const bool faces = (cosXd > 0) & (cosSd > 0) & (cosYd > 0) & (d2 > 0);
    const float inverse2 = 1 / d2;
    const float g = cosXd * inverse2 * cosYd * inverse2;
    const float unbounded = cosSd * inverse2 * cosYd * inverse2;
    const float bounded = bound * (cosSd / cosXd);
    weight[lane] = faces ? (g > bound ? bounded : unbounded) : 0.0f;
  }
}

void punctualWeights(const Vpl& vpl, const Receivers& r, size_t first, float* weight) {
  const bool spot = vpl.kind == Vpl::Kind::spot;
#pragma GCC ivdep
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    const float dx = vpl.position.x - r.px[i], dy = vpl.position.y - r.py[i],
                dz = vpl.position.z - r.pz[i];
    const float d2 = dx * dx + dy * dy + dz * dz;
    const float inverse = 1 / std::sqrt(d2);
    const float cosX = (dx * r.gx[i] + dy * r.gy[i] + dz * r.gz[i]) * inverse;
    const float cosS = (dx * r.sx[i] + dy * r.sy[i] + dz * r.sz[i]) * inverse;
    const float axis = -(dx * vpl.normal.x + dy * vpl.normal.y + dz * vpl.normal.z) * inverse;
    const float ramp = std::min(std::max(axis * vpl.coneScale + vpl.coneOffset, 0.0f), 1.0f);
    const float falloff = spot ? ramp * ramp : 1.0f;
    const bool faces = (cosX > 0) & (cosS > 0) & (d2 > 0);
    weight[lane] = faces ? falloff * cosS * inverse * inverse : 0.0f;
  }
}

void goniometricWeights(const Transport& t, const Vpl& vpl, const Receivers& r, size_t first,
                        float* weight) {
  punctualWeights(vpl, r, first, weight);
  const PunctualLight& light = t.lights[vpl.light];
  const LightProfile& profile = t.scene.profiles[static_cast<size_t>(light.profile)];
  for (size_t lane = 0; lane < kPacket; ++lane)
    if (weight[lane] > 0)
      weight[lane] *= profileTowards(profile, light.direction, light.across,
                                     glm::normalize(r.position(first + lane) - vpl.position));
}

void directionalWeights(const Vpl& vpl, const Receivers& r, size_t first, float* weight) {
  const Vec3 w = vpl.normal;
#pragma GCC ivdep
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    const float cosX = w.x * r.gx[i] + w.y * r.gy[i] + w.z * r.gz[i];
    const float cosS = w.x * r.sx[i] + w.y * r.sy[i] + w.z * r.sz[i];
    weight[lane] = ((cosX > 0) & (cosS > 0)) ? cosS : 0.0f;
  }
}

void packetWeights(const Transport& t, const Vpl& vpl, const Receivers& receivers, size_t first,
                   float* weight) {
  if (vpl.kind == Vpl::Kind::surface)
    surfaceWeights(vpl, receivers, first, weight);
  else if (vpl.kind == Vpl::Kind::directional)
    directionalWeights(vpl, receivers, first, weight);
  else if (vpl.kind == Vpl::Kind::goniometric)
    goniometricWeights(t, vpl, receivers, first, weight);
  else
    punctualWeights(vpl, receivers, first, weight);
}

}  // namespace

void VplWeights::fill(const Transport& t, std::span<const Vpl> vpls, int pathVertices,
                      const Receivers& receivers, size_t begin, size_t size) {
  size_ = size;
  if (weights_.size() < vpls.size() * size) weights_.resize(vpls.size() * size);
  for (size_t v = 0; v < vpls.size(); ++v) {
    if (pathVertices < vpls[v].firstVertex || !t.allows(vpls[v].leastCount() + pathVertices)) {
      std::fill_n(at(v, 0), size, 0.0f);
      continue;
    }
    for (size_t first = 0; first < size; first += kPacket)
      packetWeights(t, vpls[v], receivers, begin + first, at(v, first));
  }
}

}  // namespace ninefold
