// A scene in parts is the same scene: whatever was moved, and however rays are asked, the answer is
// that of single rays through one hierarchy of all. Embree's kernels differ by width, coherence and
// instruction set, and some did not return once: a watchdog ends the process then.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <memory>
#include <string>

#include "common/tracing/tracer.h"
#include "tests/seeds.h"
#include "tests/tracing/make_scene.h"

namespace ninefold {
namespace {

constexpr unsigned kPatience = 60;  // [s]; the longest test here takes less than one

// Ends the process, with the command that repeats the seed, if it outlives kPatience.
class Watchdog {
 public:
  Watchdog() {
    std::signal(SIGALRM, [](int) {
      (void)!write(STDERR_FILENO, line_.data(), line_.size());
      _exit(1);
    });
    alarm(kPatience);
  }
  ~Watchdog() { alarm(0); }

  static void watch(uint64_t seed) {
    line_ = "a ray query does not return; again: " + Repeatable::commandFor(seed) + "\n";
  }

 private:
  static inline std::string line_;
};

// Instances of random triangles, a box about them, and one in three seen through a mask.
Scene crowd(Dice& dice, int count) {
  std::vector<Mesh> meshes = {cube()};
  for (int i = 1; i < count; ++i) {
    meshes.push_back(randomTriangles(dice, 1 + dice.below(60), 1, 0.5f));
    meshes.back().uv0.resize(meshes.back().positions.size());
    for (Vec2& uv : meshes.back().uv0) uv = {dice.uniform(0, 1), dice.uniform(0, 1)};
    meshes.back().material = i % 3 == 0 ? 1 : 0;
  }
  Scene scene = sceneOf(std::move(meshes));
  scene.images.push_back({"holes", 2, 1, 4, false, {255, 255, 255, 0, 255, 255, 255, 255}});
  scene.materials.resize(2);
  scene.materials[1].alphaMode = AlphaMode::mask;
  scene.materials[1].baseColorMap.image = 0;
  scene.materials[1].baseColorMap.nearest = true;
  return scene;
}

// Moves `count` instances, and tells which.
std::vector<bool> moveSome(Dice& dice, int count, Scene& scene) {
  std::vector<bool> moved(scene.instances.size(), false);
  for (int i = 0; i < count; ++i) {
    const auto which = static_cast<size_t>(dice.below(static_cast<int>(moved.size())));
    scene.instances[which].toWorld[3] = DVec4(DVec3(dice.inBox(0.3f)), 1);
    moved[which] = true;
  }
  return moved;
}

struct Rays {
  RayPacket packet;
  Vec3 origin[kPacket], direction[kPacket];
  float far[kPacket];
};

// From one point or many, along one direction or many, some along an axis, some short.
Rays randomRays(Dice& dice) {
  Rays rays;
  const Vec3 origin = dice.inBox(0.9f), direction = dice.direction();
  const int kind = dice.below(5);
  for (int i = 0; i < kPacket; ++i) {
    rays.origin[i] = kind == 0 || kind == 2 ? dice.inBox(0.9f) : origin;
    rays.direction[i] = kind == 1 || kind == 2 ? dice.direction()
                        : kind == 3            ? direction + 0.05f * dice.direction()
                                               : direction;
    if (kind == 4) rays.direction[i] = Vec3(0), rays.direction[i][dice.below(3)] = 1;
    rays.far[i] = dice.below(3) == 0 ? kFar : dice.uniform(0.05f, 3);
    rays.packet.set(static_cast<size_t>(i), rays.origin[i], rays.direction[i], 0, rays.far[i]);
  }
  return rays;
}

bool sameHit(const Hit& a, const Hit& b) {
  if (!a || !b) return bool(a) == bool(b);
  return a.instance == b.instance && a.triangle == b.triangle && std::abs(a.t - b.t) < 1e-5f;
}

// Both queries of `tracer`, in both ways, against single rays of `truth`.
void expectSame(const Tracer& truth, const Tracer& tracer, Dice& dice) {
  const Rays rays = randomRays(dice);
  const auto active = static_cast<uint32_t>(dice.below(1 << kPacket));
  const bool coherent = dice.below(2) == 0;
  RayPacket closest = rays.packet, shadow = rays.packet;
  Hit hits[kPacket];
  tracer.closest16(closest, active, hits, coherent);
  const uint32_t blocked = tracer.occluded16(shadow, active, coherent);
  for (int i = 0; i < kPacket; ++i) {
    if ((active >> i & 1) == 0) continue;
    const Hit expected = truth.closest(rays.origin[i], rays.direction[i], rays.far[i]);
    ASSERT_TRUE(sameHit(hits[i], expected)) << "lane " << i << ", coherent " << coherent;
    ASSERT_TRUE(sameHit(tracer.closest(rays.origin[i], rays.direction[i], rays.far[i]), expected));
    ASSERT_EQ((blocked >> i & 1) != 0, bool(expected)) << "lane " << i << ", coherent " << coherent;
    ASSERT_EQ(tracer.occluded(rays.origin[i], rays.direction[i], rays.far[i]), bool(expected));
  }
}

class PartsOnIsa : public testing::TestWithParam<Isa> {};

TEST_P(PartsOnIsa, AreTracedAsOneSceneHoweverMuchOfItHasMoved) {
  const Watchdog watchdog;
  if (GetParam() == Isa::avx512 && !__builtin_cpu_supports("avx512vl"))
    GTEST_SKIP() << "no AVX-512 here";
  for (const uint64_t seed : seedsFrom(1, 60)) {
    const Repeatable repeatable(seed);
    Watchdog::watch(seed);
    Dice dice(seed);
    const int count = 2 + dice.below(24);
    const Scene asRead = crowd(dice, count);
    Scene edited = asRead;
    const std::vector<bool> moved = moveSome(dice, dice.below(2 * count), edited);
    const Tracer first(asRead, GetParam()), tracer(first, edited, moved), truth(edited, GetParam());
    for (int round = 0; round < 100; ++round)
      ASSERT_NO_FATAL_FAILURE(expectSame(truth, tracer, dice));
  }
}

// What came by many steps is what came by one: packets have the same bits.
TEST_P(PartsOnIsa, HaveTheSameBitsByManyEditsAsByOne) {
  const Watchdog watchdog;
  if (GetParam() == Isa::avx512 && !__builtin_cpu_supports("avx512vl"))
    GTEST_SKIP() << "no AVX-512 here";
  Dice dice(7);
  const Scene asRead = crowd(dice, 20);
  auto last = std::make_unique<Tracer>(asRead, GetParam());
  const Tracer first(asRead, GetParam());
  std::vector<std::unique_ptr<Scene>> scenes;
  std::vector<bool> moved(20, false);
  for (int edit = 0; edit < 30; ++edit) {
    scenes.push_back(std::make_unique<Scene>(scenes.empty() ? asRead : *scenes.back()));
    const std::vector<bool> now = moveSome(dice, 1, *scenes.back());
    for (size_t i = 0; i < now.size(); ++i) moved[i] = moved[i] || now[i];
    last = std::make_unique<Tracer>(*last, *scenes.back(), moved);
  }
  const Tracer once(first, *scenes.back(), moved);
  for (int round = 0; round < 500; ++round) {
    RayPacket a = randomRays(dice).packet, b = a;
    Hit hitsA[kPacket], hitsB[kPacket];
    last->closest16(a, 0xffff, hitsA, round % 2 == 0);
    once.closest16(b, 0xffff, hitsB, round % 2 == 0);
    ASSERT_EQ(std::memcmp(hitsA, hitsB, sizeof hitsA), 0) << round;
  }
}

INSTANTIATE_TEST_SUITE_P(Tracer, PartsOnIsa, testing::Values(Isa::avx2, Isa::avx512),
                         [](const auto& isa) {
                           return isa.param == Isa::avx2 ? "avx2" : "avx512";
                         });

}  // namespace
}  // namespace ninefold
