#include "common/scene/alpha_test.h"

#include "common/scene/texture.h"

namespace ninefold {
namespace {

Vec2 interpolateUv(const std::vector<Vec2>& uv, const Triangle& t, float u, float v) {
  return uv.empty() ? Vec2(0) : (1 - u - v) * uv[t.x] + u * uv[t.y] + v * uv[t.z];
}

}  // namespace

bool isOpenAt(const Scene& scene, const Mesh& mesh, uint32_t triangle, float u, float v) {
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  if (material.alphaMode != AlphaMode::mask) return false;
  const Triangle& t = mesh.triangles[triangle];
  float alpha = material.opacity * colorAt(mesh, t, u, v).w;
  if (material.baseColorMap) {
    alpha *= lookUp(scene, material.baseColorMap, interpolateUv(mesh.uv0, t, u, v),
                    interpolateUv(mesh.uv1, t, u, v))
                 .w;
  }
  return alpha < material.alphaCutoff;
}

}  // namespace ninefold
