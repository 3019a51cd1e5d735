#include "common/gi/vpl/vpl_gather.h"

#include <bit>

#include "common/gi/light/straight_light.h"
#include "common/math/rounding.h"

namespace ninefold {
namespace {

Vec3 rayTarget(const Transport& t, const Vpl& vpl) {
  if (vpl.kind != Vpl::Kind::surface) return vpl.position;
  return t.rayTarget(vpl.position, vpl.normal, vpl.error);
}

// Shadow rays of a packet of receivers, to a point or in a direction.
void aimRays(const Vpl& vpl, Vec3 target, const Receivers& r, size_t first, RayPacket& rays) {
  const float toPoint = vpl.kind == Vpl::Kind::directional ? 0.0f : 1.0f;
  const Vec3 to = toPoint > 0 ? target : vpl.normal;
  const float far = toPoint > 0 ? 1 : std::numeric_limits<float>::infinity();
#pragma GCC ivdep
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    rays.originX[lane] = r.ox[i], rays.directionX[lane] = to.x - toPoint * r.ox[i];
    rays.originY[lane] = r.oy[i], rays.directionY[lane] = to.y - toPoint * r.oy[i];
    rays.originZ[lane] = r.oz[i], rays.directionZ[lane] = to.z - toPoint * r.oz[i];
    rays.farT[lane] = far;
  }
}

// Lanes whose rays matter.
uint32_t activeLanes(const float* weight, size_t valid) {
  uint32_t bits[kPacket], active = 0;
  for (uint32_t lane = 0; lane < kPacket; ++lane) bits[lane] = weight[lane] > 0 ? 1u << lane : 0u;
  for (const uint32_t bit : bits) active |= bit;
  return valid >= kPacket ? active : active & ((1u << valid) - 1);
}

void addVisible(const Vpl& vpl, const float* weight, uint32_t visible, Receivers& r, size_t first) {
#pragma GCC ivdep
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const float w = (visible >> lane & 1u) != 0 ? weight[lane] : 0.0f;
    r.er[first + lane] += w * vpl.power.x;
    r.eg[first + lane] += w * vpl.power.y;
    r.eb[first + lane] += w * vpl.power.z;
  }
}

// The same where receivers lie in absorbing solids: a free segment stays within one medium.
void addThroughMedia(const Transport& t, const Vpl& vpl, const RayPacket& rays, const float* weight,
                     uint32_t visible, Receivers& r, size_t first) {
  const bool infinite = vpl.kind == Vpl::Kind::directional;
  for (size_t lane = 0; lane < kPacket; ++lane) {
    if ((visible >> lane & 1u) == 0) continue;
    const Vec3 along(rays.directionX[lane], rays.directionY[lane], rays.directionZ[lane]);
    const float distance = infinite ? std::numeric_limits<float>::infinity() : glm::length(along);
    const Vec3 left = t.shader.transmittance(r.absorber[first + lane], distance);
    r.addIrradiance(first + lane, weight[lane] * left * vpl.power);
  }
}

// What the VPL sends to x [W/sr].
Vec3 powerTo(const Transport& t, const VplSet& lights, const Vpl& vpl, int pathVertices, Vec3 x) {
  if (vpl.glossy < 0) return vpl.power;
  const Vec3 glossy = lights.glossy[static_cast<size_t>(vpl.glossy)].intensityOverCosine(
      glm::normalize(x - vpl.position));
  return t.allows(vpl.diffuseCount + pathVertices) ? glossy + vpl.power : glossy;
}

// The same for a VPL with a glossy lobe: each receiver sees it from a direction of its own.
void addGlossy(const Transport& t, const VplSet& lights, const Vpl& vpl, const RayPacket& rays,
               const float* weight, uint32_t visible, int pathVertices, Receivers& r,
               size_t first) {
  for (size_t lane = 0; lane < kPacket; ++lane) {
    if ((visible >> lane & 1u) == 0) continue;
    const Vec3 along(rays.directionX[lane], rays.directionY[lane], rays.directionZ[lane]);
    const Vec3 power = powerTo(t, lights, vpl, pathVertices, r.position(first + lane));
    const Vec3 left = t.shader.transmittance(r.absorber[first + lane], glm::length(along));
    r.addIrradiance(first + lane, weight[lane] * left * power);
  }
}

// What passes straight through that which blocks these lanes.
void addStraight(const Transport& t, const VplSet& lights, const Vpl& vpl, RayPacket& rays,
                 Vec3 target, const float* weight, uint32_t blocked, int pathVertices, Receivers& r,
                 size_t first, uint64_t& shadowRays) {
  aimRays(vpl, target, r, first, rays);
  for (size_t lane = 0; lane < kPacket; ++lane) {
    if ((blocked >> lane & 1u) == 0) continue;
    const Vec3 along(rays.directionX[lane], rays.directionY[lane], rays.directionZ[lane]);
    const Vec3 left =
        straightVisibility(t, r.origin(first + lane), along, rays.farT[lane], shadowRays);
    if (isBlack(left)) continue;
    const float distance = rays.farT[lane] * glm::length(along);
    r.addIrradiance(first + lane,
                    weight[lane] * left *
                        t.shader.transmittance(r.absorber[first + lane], distance) *
                        powerTo(t, lights, vpl, pathVertices, r.position(first + lane)));
  }
}

// Asks for light along the rays of one VPL to a chunk of receivers, and adds it. Its weights are
// those of row `row`.
void traceVpl(const Transport& t, const VplSet& lights, const Vpl& vpl, size_t row,
              int pathVertices, VplGatherScratch& scratch, size_t begin, Receivers& receivers,
              uint64_t& shadowRays) {
  RayPacket& rays = scratch.rays;
  const Vec3 target = rayTarget(t, vpl);
  for (size_t first = 0; first < scratch.weights.size(); first += kPacket) {
    const float* weight = scratch.weights.at(row, first);
    const uint32_t active = activeLanes(weight, receivers.size() - begin - first);
    if (active == 0) continue;
    aimRays(vpl, target, receivers, begin + first, rays);
    shadowRays += static_cast<uint64_t>(std::popcount(active));
    const uint32_t visible = active & ~t.tracer.occluded16(rays, active);
    if (visible != active && !t.straightBounds.empty())
      addStraight(t, lights, vpl, rays, target, weight, active & ~visible, pathVertices, receivers,
                  begin + first, shadowRays);
    if (vpl.glossy >= 0)
      addGlossy(t, lights, vpl, rays, weight, visible, pathVertices, receivers, begin + first);
    else if (receivers.absorbs())
      addThroughMedia(t, vpl, rays, weight, visible, receivers, begin + first);
    else
      addVisible(vpl, weight, visible, receivers, begin + first);
  }
}

size_t paddedSize(const Receivers& receivers) {
  return (receivers.size() + kPacket - 1) / kPacket * kPacket;
}

}  // namespace

void gatherVpls(const Transport& t, const VplSet& lights, const ReceiverSamples& samples,
                int pathVertices, float roulette, VplGatherScratch& scratch, Receivers& receivers,
                uint64_t& shadowRays) {
  const std::vector<Vpl>& vpls = lights.vpls;
  const size_t padded = paddedSize(receivers);
  const size_t chunk = VplWeights::chunk(vpls.size());
  for (size_t begin = 0; begin < padded; begin += chunk) {
    scratch.weights.fill(t, vpls, pathVertices, receivers, begin, std::min(chunk, padded - begin));
    scratch.roulette.play(roulette, lights, samples, pathVertices, receivers, begin,
                          scratch.weights);
    for (size_t v = 0; v < vpls.size(); ++v)
      traceVpl(t, lights, vpls[v], v, pathVertices, scratch, begin, receivers, shadowRays);
  }
}

void gatherOneVpl(const Transport& t, const VplSet& lights, const Vpl& vpl, int pathVertices,
                  VplGatherScratch& scratch, Receivers& receivers, uint64_t& shadowRays) {
  scratch.weights.fill(t, {&vpl, 1}, pathVertices, receivers, 0, paddedSize(receivers));
  traceVpl(t, lights, vpl, 0, pathVertices, scratch, 0, receivers, shadowRays);
}

}  // namespace ninefold
