#include "common/gi/light/media_around.h"

namespace ninefold {

MediumStack mediaAround(const Transport& t, Vec3 place) {
  MediumStack media, entered;
  Vec3 origin = place;
  const Vec3 direction = glm::normalize(Vec3(0.3f, 0.9f, 0.2f));
  for (int i = 0; i < 64; ++i) {
    const Hit hit = t.tracer.closest(origin, direction, std::numeric_limits<float>::infinity());
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
