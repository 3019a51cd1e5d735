#include "common/gi/vpl_gather.h"

#include <bit>

#include "common/math/rounding.h"

namespace ninefold {
namespace {

// Scalar weight of the VPL's power at sixteen receivers, and the segments to test.
struct alignas(64) PacketWeights {
  float weight[kPacket];
  float toX[kPacket], toY[kPacket], toZ[kPacket];  // from shadow ray origin to its end
};

// Where shadow rays to a surface VPL end: off its surface, on the emitting side, by what rounding
// may do on the way from anywhere in the scene.
Vec3 rayTarget(const Transport& t, const Vpl& vpl) {
  if (vpl.kind != Vpl::Kind::surface) return vpl.position;
  return offsetOrigin(vpl.position, vpl.normal, vpl.error + t.farRounding, vpl.normal);
}

// Straight-line loops over planar arrays: the compiler turns them into vector code.
void surfaceWeights(const Vpl& vpl, Vec3 target, float bound, const Receivers& r, size_t first,
                    PacketWeights& out) {
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    const float dx = vpl.position.x - r.px[i], dy = vpl.position.y - r.py[i],
                dz = vpl.position.z - r.pz[i];
    const float d2 = dx * dx + dy * dy + dz * dz;
    const float cosXd = dx * r.gx[i] + dy * r.gy[i] + dz * r.gz[i];  // cos * d
    const float cosSd = dx * r.sx[i] + dy * r.sy[i] + dz * r.sz[i];
    const float cosYd = -(dx * vpl.normal.x + dy * vpl.normal.y + dz * vpl.normal.z);
    const bool faces = cosXd > 0 && cosSd > 0 && cosYd > 0 && d2 > 0;
    const float inverse2 = 1 / d2;
    const float g = cosXd * inverse2 * cosYd * inverse2;
    const float unbounded = cosSd * inverse2 * cosYd * inverse2;
    const float bounded = bound * (cosSd / cosXd);
    out.weight[lane] = faces ? (g > bound ? bounded : unbounded) : 0.0f;
    out.toX[lane] = target.x - r.ox[i], out.toY[lane] = target.y - r.oy[i],
    out.toZ[lane] = target.z - r.oz[i];
  }
}

void punctualWeights(const Vpl& vpl, const Receivers& r, size_t first, PacketWeights& out) {
  const bool spot = vpl.kind == Vpl::Kind::spot;
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
    const bool faces = cosX > 0 && cosS > 0 && d2 > 0;
    out.weight[lane] = faces ? falloff * cosS * inverse * inverse : 0.0f;
    out.toX[lane] = vpl.position.x - r.ox[i], out.toY[lane] = vpl.position.y - r.oy[i],
    out.toZ[lane] = vpl.position.z - r.oz[i];
  }
}

void directionalWeights(const Vpl& vpl, const Receivers& r, size_t first, PacketWeights& out) {
  const Vec3 w = vpl.normal;
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    const float cosX = w.x * r.gx[i] + w.y * r.gy[i] + w.z * r.gz[i];
    const float cosS = w.x * r.sx[i] + w.y * r.sy[i] + w.z * r.sz[i];
    out.weight[lane] = cosX > 0 && cosS > 0 ? cosS : 0.0f;
    out.toX[lane] = w.x, out.toY[lane] = w.y, out.toZ[lane] = w.z;
  }
}

// Lanes that matter, with their rays set up.
uint32_t setUpRays(const PacketWeights& weights, const Receivers& r, size_t first, float tFar,
                   RayPacket& rays) {
  const size_t valid = std::min<size_t>(kPacket, r.size() - first);
  uint32_t active = 0;
  for (size_t lane = 0; lane < valid; ++lane)
    active |= (weights.weight[lane] > 0 ? 1u : 0u) << lane;
  if (active == 0) return 0;
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    rays.originX[lane] = r.ox[i], rays.originY[lane] = r.oy[i], rays.originZ[lane] = r.oz[i];
    rays.directionX[lane] = weights.toX[lane], rays.directionY[lane] = weights.toY[lane];
    rays.directionZ[lane] = weights.toZ[lane];
    rays.nearT[lane] = 0, rays.farT[lane] = tFar;
    rays.time[lane] = 0, rays.mask[lane] = ~0u, rays.id[lane] = 0, rays.flags[lane] = 0;
  }
  return active;
}

void addVisible(const Vpl& vpl, const PacketWeights& weights, uint32_t visible, Receivers& r,
                size_t first) {
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const float w = (visible >> lane & 1u) != 0 ? weights.weight[lane] : 0.0f;
    r.er[first + lane] += w * vpl.power.x;
    r.eg[first + lane] += w * vpl.power.y;
    r.eb[first + lane] += w * vpl.power.z;
  }
}

}  // namespace

void gatherVpls(const Transport& t, const std::vector<Vpl>& vpls, int pathVertices,
                Receivers& receivers, uint64_t& shadowRays) {
  RayPacket rays;
  PacketWeights weights;
  for (const Vpl& vpl : vpls) {
    if (!t.allows(vpl.diffuseCount + pathVertices)) continue;
    const Vec3 target = rayTarget(t, vpl);
    const bool directional = vpl.kind == Vpl::Kind::directional;
    const float tFar = directional ? std::numeric_limits<float>::infinity() : 1.0f;
    for (size_t first = 0; first < receivers.size(); first += kPacket) {
      if (vpl.kind == Vpl::Kind::surface)
        surfaceWeights(vpl, target, t.bound, receivers, first, weights);
      else if (directional)
        directionalWeights(vpl, receivers, first, weights);
      else
        punctualWeights(vpl, receivers, first, weights);
      const uint32_t active = setUpRays(weights, receivers, first, tFar, rays);
      if (active == 0) continue;
      shadowRays += static_cast<uint64_t>(std::popcount(active));
      addVisible(vpl, weights, active & ~t.tracer.occluded16(rays, active), receivers, first);
    }
  }
}

}  // namespace ninefold
