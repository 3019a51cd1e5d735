// Which radius a photon gets: none is brighter than the limit, and none wider than it must be.
#include "common/gi/photons/photon_radii.h"

#include <gtest/gtest.h>

#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A room of the given size lit by a lamp of 1 W/m^2.
Scene room(float size) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(-size), Vec3(size), true);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(kInvPi))), size * Vec3(-0.5f, 0.9f, -0.5f),
         size * Vec3(1, 0, 0), size * Vec3(0, 0, 1));
  b.camera(Vec3(0), Vec3(0, 0, -1), 1);
  return b.build();
}

TEST(PhotonRadii, NoPhotonIsBrighterThanTheLimitNorWiderThanItMustBe) {
  for (const float size : {1e-3f, 1.0f, 1e4f}) {
    const Scene scene = room(size);
    const Tracer tracer(scene, Isa::automatic);
    const Transport t(tracer, Settings{});
    const float R = scene.bounds.radius(), r = t.settings.photonRadius * R;
    const float lamp = size * size;  // [W]
    const float limit = lamp / (4 * kPi * R * R);
    const PhotonRadii radii(t, r);
    for (float part = 1e-9f; part < 1; part *= 1.7f) {
      const size_t j = radii.choose(Flux(part * lamp, 0, 0));
      const auto brightness = [&](size_t k) {
        return part * lamp / (kPi * radii.radius(k) * radii.radius(k));
      };
      EXPECT_TRUE(j + 1 == kPhotonKinds || brightness(j) <= 1.001f * limit) << part;
      EXPECT_TRUE(j == kPhotonHalvings || brightness(j - 1) > 0.999f * limit) << part;
    }
  }
}

// As the film accumulates, all radii shrink alike: each photon keeps its multiple of r.
TEST(PhotonRadii, ShrinkTogether) {
  const Scene scene = room(1);
  const Tracer tracer(scene, Isa::automatic);
  const Transport t(tracer, Settings{});
  const float r = t.settings.photonRadius * scene.bounds.radius();
  const PhotonRadii first(t, r), later(t, 0.01f * r);
  for (float flux = 1e-9f; flux < 1; flux *= 2)
    EXPECT_EQ(first.choose(Flux(flux)), later.choose(Flux(flux)));
  for (size_t j = 0; j < kPhotonKinds; ++j) {
    EXPECT_FLOAT_EQ(later.radius(j), 0.01f * first.radius(j));
    EXPECT_EQ(later.first(j), first.radius(j));
  }
  EXPECT_EQ(first.radius(kPhotonHalvings), r);
}

}  // namespace
}  // namespace ninefold
