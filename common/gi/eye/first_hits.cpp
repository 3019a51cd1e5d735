#include "common/gi/eye/first_hits.h"

namespace ninefold {
namespace {

Vec3 albedoOf(const ShadingPoint& p) {
  Vec3 albedo = p.bsdf.diffuse;
  const float cosine = p.localWo().z;
  if (p.bsdf.reflects) albedo += lobeAlbedo(p.bsdf, Lobe::reflection, cosine);
  if (p.bsdf.transmits()) albedo += lobeAlbedo(p.bsdf, Lobe::transmission, cosine);
  return glm::min(albedo, Vec3(1));
}

void fillExtras(TaskContext& c, const FirstHit& first) {
  ExtraPlanes& e = c.out.extras;
  const ShadingPoint& p = first.point;
  if (c.wants(kAlbedoPlane)) put(e.albedo, first.pixel, albedoOf(p));
  if (c.wants(kNormalPlane)) put(e.normal, first.pixel, p.ns);
  if (c.wants(kDepthPlane))
    e.depth[first.pixel] = first.distance * glm::dot(first.direction, c.view.camera.forward);
  if (c.wants(kObjectPlane)) e.object[first.pixel] = p.surface.instance + 1;
}

}  // namespace

EyeBlock traceBlock(TaskContext& c, uint32_t path, int bi, int bj) {
  EyeBlock block;
  block.bi = bi, block.bj = bj;
  for (int lane = 0; lane < kPacket; ++lane) {
    const int i = std::min(bi + lane % kBlockSide, c.rect.width - 1);
    const int j = std::min(bj + lane / kBlockSide, c.rect.height - 1);
    const int x = c.pixelX(i), y = c.pixelY(j);
    const Vec2 offset = c.t.settings.jitter ? c.sampler(x, y, path).get2D(0) : Vec2(0.5f);
    const float px = static_cast<float>(x) + offset.x, py = static_cast<float>(y) + offset.y;
    block.rays.set(static_cast<size_t>(lane), c.view.camera.eye + c.camera.start(px, py),
                   c.camera.direction(px, py), 0, std::numeric_limits<float>::infinity());
    const bool inside =
        bi + lane % kBlockSide < c.rect.width && bj + lane / kBlockSide < c.rect.height;
    block.active |= (inside ? 1u : 0u) << lane;
  }
  c.t.tracer.closest16(block.rays, block.active, block.hits);
  return block;
}

FirstHit firstHitOf(TaskContext& c, uint32_t path, const EyeBlock& block, int lane) {
  ++c.out.rays.eye;
  const int i = block.bi + lane % kBlockSide, j = block.bj + lane / kBlockSide;
  const auto pixel = static_cast<size_t>(j * c.rect.width + i);
  const int x = c.pixelX(i), y = c.pixelY(j);
  const RayPacket& rays = block.rays;
  const Vec3 direction(rays.directionX[lane], rays.directionY[lane], rays.directionZ[lane]);
  const Hit& hit = block.hits[lane];
  if (!hit) return {pixel, x, y, direction, 0, {}};
  const FirstHit first{
      pixel,     x,     y,
      direction, hit.t, c.t.shader.shade(c.t.tracer.surface(hit), -direction, c.view.eyeMedia)};
  if (path == 0 && c.task.extraMask != 0) fillExtras(c, first);
  return first;
}

}  // namespace ninefold
