#include "common/gi/light/media_around.h"

#include <algorithm>

#include "common/math/box_rays.h"

namespace ninefold {

Vec3 wayOutOfMedia() { return glm::normalize(Vec3(0.3f, 0.9f, 0.2f)); }

MediumStack mediaAround(const Transport& t, Vec3 place) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const Vec3 direction = wayOutOfMedia();
  MediumStack media, entered;
  if (std::ranges::none_of(
          t.solidBounds, [&](const Bounds& box) { return meetsBox(box, place, direction, kFar); }))
    return media;
  Vec3 origin = place;
  for (int i = 0; i < 64; ++i) {
    const Hit hit = t.tracer.closest(origin, direction, kFar);
    if (!hit) break;
    const SurfacePoint s = t.tracer.surface(hit);
    const bool fromFront = glm::dot(direction, s.geometricNormal) < 0;
    t.shader.forEachCrossed(s, fromFront, [&](int material, bool enters) {
      if (enters)
        t.shader.enter(entered, material);
      else if (entered.contains(material))
        entered.leave(material);
      else
        t.shader.enter(media, material);
    });
    origin = offsetOrigin(s, direction);
  }
  return media;
}

}  // namespace ninefold
