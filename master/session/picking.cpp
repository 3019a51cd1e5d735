#include "master/session/picking.h"

#include <algorithm>

#include "common/scene/world.h"

namespace ninefold {
namespace {

// The pixel of a film position, and the nearest one for a position outside.
size_t pixelAt(const LiveImage& image, Vec2 film) {
  return image.at(std::clamp(static_cast<int>(film.x), 0, image.width - 1),
                  std::clamp(static_cast<int>(film.y), 0, image.height - 1));
}

}  // namespace

std::optional<uint32_t> instanceAt(const Shown& shown, Vec2 film) {
  const uint32_t object = shown.image->picks->objects[pixelAt(*shown.image, film)];
  if (object == 0) return std::nullopt;
  return object - 1;
}

std::optional<Vec3> pointAt(const Shown& shown, Vec2 film) {
  const LiveImage& image = *shown.image;
  if (image.picks == nullptr) return std::nullopt;
  const float depth = image.picks->depth[pixelAt(image, film)];
  if (!(depth > 0)) return std::nullopt;
  const Camera& camera = shown.frame.order.settings.camera;
  const CameraRays rays(camera, image.width, image.height);
  return camera.eye + rays.atDepth(film.x, film.y, depth);
}

void drawOutline(const Shown& shown, const Scene& scene, const Selection& selection,
                 std::vector<uint8_t>& rgb) {
  const LiveImage& image = *shown.image;
  if (image.picks == nullptr) return;
  const std::vector<uint32_t>& objects = image.picks->objects;
  const auto isSelected = [&](int x, int y) {
    const uint32_t object = objects[image.at(x, y)];
    return object != 0 && scene.instances[object - 1].node == selection.node;
  };
  const auto touchesSelected = [&](int x, int y) {
    return isSelected(x - 1, y) || isSelected(x + 1, y) || isSelected(x, y - 1) ||
           isSelected(x, y + 1);
  };
  for (int y = 1; y + 1 < image.height; ++y)
    for (int x = 1; x + 1 < image.width; ++x) {
      if (isSelected(x, y) || !touchesSelected(x, y)) continue;
      const size_t at = 3 * image.at(x, y);
      rgb[at] = 255, rgb[at + 1] = 160, rgb[at + 2] = 0;
    }
}

Bounds boundsOfNode(const Scene& scene, int node, const DMat4& motion) {
  Bounds bounds;
  for (const Instance& instance : scene.instances)
    if (instance.node == node)
      for (const Vec3& p : scene.meshes[static_cast<size_t>(instance.mesh)].positions)
        bounds.add(worldPoint(motion * instance.toWorld, p));
  return bounds;
}

}  // namespace ninefold
