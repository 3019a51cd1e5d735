// Every method against the reference path tracer on rooms that need every estimator. Both
// render the same scene, camera and path count rules; the means of the image must agree within four
// standard errors plus a bias that is stated for each room (bound of the geometry term, photon
// radius).
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

struct Room {
  SceneBuilder b;
  explicit Room(float wallAlbedo = 0.6f) {
    const int grey = b.material(testing::matte(Vec3(wallAlbedo)));
    const int red = b.material(testing::matte(Vec3(0.6f, 0.1f, 0.1f)));
    const int lamp = b.material(testing::matte(Vec3(0), Vec3(10)));
    b.box(grey, Vec3(-1), Vec3(1), true);
    b.quad(red, Vec3(-0.999f, -1, -1), Vec3(0, 2, 0), Vec3(0, 0, 2));             // looks along +x
    b.quad(lamp, Vec3(-0.3f, 0.99f, -0.3f), Vec3(0.6f, 0, 0), Vec3(0, 0, 0.6f));  // looks down
    b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.25f, -1), 1.2f);
  }
};

struct Allowed {
  double bias = 0.01;  // relative, stated for the room
  int frames = 24;
  float radius = 0.01f;
  int pathLength = 0;
};

void expectAgreement(const Scene& scene, Allowed allowed) {
  const Tracer tracer(scene, Isa::automatic);
  const auto reference = testing::render(
      tracer, testing::reference(12, allowed.pathLength).settings, 4 * allowed.frames);
  for (testing::Estimator& e : testing::othersThanReference(12, allowed.pathLength)) {
    // What comes near the singularity of one VPL lights all that a reverse VPL does.
    if (!e.facts().has(kReverseVpls)) e.settings.bound = 3000;
    e.settings.photonRadius = allowed.radius;
    e.settings.directVpls = 8, e.settings.indirectVpls = 48;
    const auto image = testing::render(tracer, e.settings, allowed.frames);
    const double error = std::hypot(image.error(), reference.error());
    EXPECT_NEAR(image.grey(), reference.grey(), 4 * error + allowed.bias * reference.grey())
        << e.name << ": " << image.grey() << " +- " << image.error() << ", reference "
        << reference.grey() << " +- " << reference.error();
    EXPECT_LT(error, 0.02 * reference.grey()) << e.name;
  }
}

TEST(Agreement, DiffuseRoom) { expectAgreement(Room().b.build(), {}); }

TEST(Agreement, DiffuseRoomWithThreeVerticesAtMost) {
  expectAgreement(Room().b.build(), {.pathLength = 3});
}

TEST(Agreement, GlassBallWithItsCaustic) {
  Room room;
  room.b.sphere(room.b.material(testing::glass(1.5f)), Vec3(0.2f, -0.5f, -0.2f), 0.4f, 32);
  expectAgreement(room.b.build(), {.bias = 0.015, .frames = 48});
}

// What a ball floating half in water throws on the floor, seen from below the ball: particles come
// to it from above, eye paths through the water, and both must find glass where the two overlap,
// whichever the file has first.
class BallHalfInWater : public ::testing::Test {
 protected:
  void addBall() { b_.sphere(b_.material(testing::glass(1.5f)), Vec3(0, -0.4f, 0), 0.3f, 32); }
  void addWater() {
    b_.box(b_.material(testing::glass(1.33f)), Vec3(-1), Vec3(1, -0.4f, 1), false);
  }
  void expectCaustic() {
    b_.camera(Vec3(0, -0.75f, 0), Vec3(0, -1, 0), 1.2f, Vec3(0, 0, 1));
    expectAgreement(b_.build(), {.bias = 0.015, .frames = 48});
  }

 private:
  Room room_;
  SceneBuilder& b_ = room_.b;
};

TEST_F(BallHalfInWater, CausticBallFirst) {
  addBall(), addWater();
  expectCaustic();
}

TEST_F(BallHalfInWater, CausticWaterFirst) {
  addWater(), addBall();
  expectCaustic();
}

TEST(Agreement, MirrorWallAndItsReflectedLight) {
  Room room;
  const int silver = room.b.material(testing::mirror(Vec3(0.9f)));
  room.b.quad(silver, Vec3(0.99f, -0.8f, 0.8f), Vec3(0, 1.6f, 0), Vec3(0, 0, -1.6f));
  expectAgreement(room.b.build(), {.bias = 0.015, .frames = 48});
}

TEST(Agreement, RoughMetalBall) {
  Room room;
  Material metal = testing::mirror(Vec3(0.9f, 0.7f, 0.4f));
  metal.roughness = 0.4f;
  room.b.sphere(room.b.material(metal), Vec3(0.2f, -0.5f, -0.2f), 0.45f, 32);
  expectAgreement(room.b.build(), {.bias = 0.015, .frames = 48});
}

TEST(Agreement, PolishedFloorOverPaint) {
  Room room;
  Material polished = testing::matte(Vec3(0.3f, 0.5f, 0.3f));
  polished.specular = 1, polished.roughness = 0.1f;
  room.b.quad(room.b.material(polished), Vec3(-0.95f, -0.99f, 0.95f), Vec3(1.9f, 0, 0),
              Vec3(0, 0, -1.9f));
  expectAgreement(room.b.build(), {.bias = 0.015, .frames = 48});
}

TEST(Agreement, ThinPaneAndBlendedCurtain) {
  Room room;
  Material pane = testing::glass(1.5f);
  pane.solid = false, pane.baseColor = Vec3(0.7f, 0.9f, 1);
  Material curtain = testing::matte(Vec3(0.8f));
  curtain.alphaMode = AlphaMode::blend, curtain.opacity = 0.4f;
  room.b.quad(room.b.material(pane), Vec3(-0.9f, -0.9f, -0.2f), Vec3(0.8f, 0, 0), Vec3(0, 1.5f, 0));
  room.b.quad(room.b.material(curtain), Vec3(0.1f, -0.9f, -0.1f), Vec3(0.8f, 0, 0),
              Vec3(0, 1.5f, 0));
  expectAgreement(room.b.build(), {.bias = 0.015, .frames = 48});
}

TEST(Agreement, RoughGlassAndAttenuation) {
  Room room;
  Material frosted = testing::glass(1.4f);
  frosted.roughness = 0.3f;
  frosted.attenuationColor = Vec3(0.3f, 0.8f, 0.5f), frosted.attenuationDistance = 0.5f;
  room.b.sphere(room.b.material(frosted), Vec3(0.2f, -0.5f, -0.2f), 0.4f, 32);
  expectAgreement(room.b.build(), {.bias = 0.015, .frames = 48});
}

TEST(Agreement, OpenSkyOverABox) {
  SceneBuilder b;
  const int ground = b.material(testing::matte(Vec3(0.5f)));
  b.quad(ground, Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4));
  b.box(b.material(testing::matte(Vec3(0.7f, 0.4f, 0.2f))), Vec3(-0.5f, 0.01f, -0.5f),
        Vec3(0.5f, 1, 0.5f), false);
  b.environment(Radiance(1, 1, 1.5f)).camera(Vec3(0, 1.5f, 3), Vec3(0, 0.3f, 0), 0.9f);
  expectAgreement(b.build(), {});
}

}  // namespace
}  // namespace ninefold
