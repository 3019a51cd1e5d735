#include "common/gi/vpl_gather.h"

#include <bit>

#include "common/math/rounding.h"

namespace ninefold {
namespace {

// Sixteen shadow rays to one VPL, and the weight of its power at their receivers; 0 = no ray.
struct alignas(64) VplRays {
  RayPacket rays;
  float weight[kPacket];

  VplRays() {
    for (int lane = 0; lane < kPacket; ++lane) rays.set(lane, Vec3(0), Vec3(0), 0, 0);
  }
};

// Where shadow rays to a surface VPL end: off its surface, on the emitting side, by what rounding
// may do on the way from anywhere in the scene.
Vec3 rayTarget(const Transport& t, const Vpl& vpl) {
  if (vpl.kind != Vpl::Kind::surface) return vpl.position;
  return offsetOrigin(vpl.position, vpl.normal, vpl.error + t.farRounding, vpl.normal);
}

// Straight-line loops over planar arrays: the compiler turns them into vector code.
void surfaceWeights(const Vpl& vpl, Vec3 target, float bound, const Receivers& r, size_t first,
                    VplRays& out) {
  RayPacket& rays = out.rays;
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
    out.weight[lane] = faces ? (g > bound ? bounded : unbounded) : 0.0f;
    rays.originX[lane] = r.ox[i], rays.directionX[lane] = target.x - r.ox[i];
    rays.originY[lane] = r.oy[i], rays.directionY[lane] = target.y - r.oy[i];
    rays.originZ[lane] = r.oz[i], rays.directionZ[lane] = target.z - r.oz[i];
    rays.farT[lane] = 1;
  }
}

void punctualWeights(const Vpl& vpl, const Receivers& r, size_t first, VplRays& out) {
  RayPacket& rays = out.rays;
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
    out.weight[lane] = faces ? falloff * cosS * inverse * inverse : 0.0f;
    rays.originX[lane] = r.ox[i], rays.directionX[lane] = vpl.position.x - r.ox[i];
    rays.originY[lane] = r.oy[i], rays.directionY[lane] = vpl.position.y - r.oy[i];
    rays.originZ[lane] = r.oz[i], rays.directionZ[lane] = vpl.position.z - r.oz[i];
    rays.farT[lane] = 1;
  }
}

void directionalWeights(const Vpl& vpl, const Receivers& r, size_t first, VplRays& out) {
  RayPacket& rays = out.rays;
  const Vec3 w = vpl.normal;
#pragma GCC ivdep
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    const float cosX = w.x * r.gx[i] + w.y * r.gy[i] + w.z * r.gz[i];
    const float cosS = w.x * r.sx[i] + w.y * r.sy[i] + w.z * r.sz[i];
    out.weight[lane] = (cosX > 0) & (cosS > 0) ? cosS : 0.0f;
    rays.originX[lane] = r.ox[i], rays.directionX[lane] = w.x;
    rays.originY[lane] = r.oy[i], rays.directionY[lane] = w.y;
    rays.originZ[lane] = r.oz[i], rays.directionZ[lane] = w.z;
    rays.farT[lane] = std::numeric_limits<float>::infinity();
  }
}

// Lanes whose rays matter.
uint32_t activeLanes(const VplRays& packet, size_t valid) {
  uint32_t bits[kPacket], active = 0;
  for (uint32_t lane = 0; lane < kPacket; ++lane)
    bits[lane] = packet.weight[lane] > 0 ? 1u << lane : 0u;
  for (const uint32_t bit : bits) active |= bit;
  return valid >= kPacket ? active : active & ((1u << valid) - 1);
}

void addVisible(const Vpl& vpl, const VplRays& packet, uint32_t visible, Receivers& r,
                size_t first) {
#pragma GCC ivdep
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const float w = (visible >> lane & 1u) != 0 ? packet.weight[lane] : 0.0f;
    r.er[first + lane] += w * vpl.power.x;
    r.eg[first + lane] += w * vpl.power.y;
    r.eb[first + lane] += w * vpl.power.z;
  }
}

}  // namespace

void gatherVpls(const Transport& t, const std::vector<Vpl>& vpls, int pathVertices,
                Receivers& receivers, uint64_t& shadowRays) {
  VplRays packet;
  for (const Vpl& vpl : vpls) {
    if (!t.allows(vpl.diffuseCount + pathVertices)) continue;
    const Vec3 target = rayTarget(t, vpl);
    for (size_t first = 0; first < receivers.size(); first += kPacket) {
      if (vpl.kind == Vpl::Kind::surface)
        surfaceWeights(vpl, target, t.bound, receivers, first, packet);
      else if (vpl.kind == Vpl::Kind::directional)
        directionalWeights(vpl, receivers, first, packet);
      else
        punctualWeights(vpl, receivers, first, packet);
      const uint32_t active = activeLanes(packet, receivers.size() - first);
      if (active == 0) continue;
      shadowRays += static_cast<uint64_t>(std::popcount(active));
      const uint32_t visible = active & ~t.tracer.occluded16(packet.rays, active);
      addVisible(vpl, packet, visible, receivers, first);
    }
  }
}

}  // namespace ninefold
