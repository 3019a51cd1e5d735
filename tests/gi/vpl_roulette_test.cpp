// Fewer shadow rays with the same mean: the choice of VPLs alone, and through the gather.
#include "common/gi/vpl/vpl_roulette.h"

#include <gtest/gtest.h>

#include <random>

#include "common/gi/vpl/vpl_gather.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// An open floor under `count` VPLs of very different strength, without any shadow.
struct Open {
  SceneBuilder builder;
  Scene scene;
  std::vector<Vpl> vpls;
  Receivers receivers;

  explicit Open(int count) {
    builder.quad(builder.material(testing::matte(Vec3(0.5f))), Vec3(-1, 0, -1), Vec3(0, 0, 2),
                 Vec3(2, 0, 0));
    builder.camera(Vec3(0, 3, 0), Vec3(0, -1, 0), 1, Vec3(1, 0, 0));
    scene = builder.build();
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (int v = 0; v < count; ++v) {
      Vpl vpl;
      vpl.position = Vec3(uniform(random), 1.5f + uniform(random) / 2, uniform(random));
      vpl.normal = Vec3(0, -1, 0);
      vpl.power = Vec3(std::pow(10.0f, 2 * uniform(random)));
      vpls.push_back(vpl);
    }
    for (uint32_t i = 0; i < 48; ++i) {
      const Vec3 x(uniform(random), 0, uniform(random)), up(0, 1, 0);
      receivers.add(Receiver{x, up, up, x + 1e-5f * up, i, 1});
    }
    receivers.pad();
  }

  // Mean and its standard error at each receiver, and rays an independent trial.
  struct Result {
    std::vector<double> mean, error;
    double rays = 0;
  };
  Result gather(float f, int trials, int first = 0) {
    const Tracer tracer(scene, Isa::automatic);
    Settings settings;
    settings.vplRoulette = f;
    const Transport transport(tracer, settings);
    VplGatherScratch scratch;
    std::vector<double> sum(receivers.size()), squares(receivers.size());
    uint64_t rays = 0;
    for (int trial = 0; trial < trials; ++trial) {
      std::fill(receivers.er.begin(), receivers.er.end(), 0.0f);
      const ReceiverSamples samples(0, static_cast<uint32_t>(first + trial), 0);
      gatherVpls(transport, {vpls, {}}, samples, 1, f, scratch, receivers, rays);
      for (size_t i = 0; i < sum.size(); ++i) {
        const auto e = static_cast<double>(receivers.er[i]);
        sum[i] += e, squares[i] += e * e;
      }
    }
    Result r;
    r.rays = static_cast<double>(rays) / trials;
    for (size_t i = 0; i < sum.size(); ++i) {
      const double mean = sum[i] / trials;
      r.mean.push_back(mean);
      r.error.push_back(std::sqrt(std::max(squares[i] / trials - mean * mean, 0.0) / trials));
    }
    return r;
  }
};

TEST(VplRoulette, KeepsTheMeanAndSavesRays) {
  for (const int count : {1, 2, 22, 600}) {
    Open scene(count);
    const auto all = scene.gather(0, 1);
    for (const float f : {0.5f, 2.0f, 50.0f}) {
      const auto some = scene.gather(f, 2000);
      for (size_t i = 0; i < all.mean.size(); ++i)
        ASSERT_NEAR(some.mean[i], all.mean[i], 5 * some.error[i] + 1e-4 * all.mean[i])
            << count << " VPLs, f " << f << ", receiver " << i;
      EXPECT_LE(some.rays, all.rays);
      EXPECT_TRUE(count != 22 || f < 2 || some.rays < 0.5 * all.rays) << some.rays;
    }
  }
}

// Five lights are not worth any noise: nothing changes, bit for bit.
TEST(VplRoulette, AFewLightsAreAskedAlways) {
  Open scene(0);
  scene.receivers.clear();
  const Vec3 up(0, 1, 0);
  scene.receivers.add(Receiver{Vec3(0), up, up, Vec3(0, 1e-5f, 0), 7, 1});
  scene.receivers.pad();
  for (int v = 0; v < 5; ++v) {
    Vpl vpl;
    vpl.position = Vec3(0, 1, 0), vpl.normal = -up,
    vpl.power = Vec3(std::pow(10.0f, static_cast<float>(v)));
    scene.vpls.push_back(vpl);
  }
  EXPECT_EQ(scene.gather(100, 1).mean, scene.gather(0, 1).mean);
  EXPECT_EQ(scene.gather(100, 1).rays, 5);
}

// The number of rays hardly varies: at most one more or less than expected for each packet.
TEST(VplRoulette, TakesAsManyAsExpected) {
  Open scene(40);
  const double expected = scene.gather(4, 4000).rays;
  for (int trial = 0; trial < 50; ++trial)
    EXPECT_NEAR(scene.gather(4, 1, trial).rays, expected, 48) << "three packets of sixteen lanes";
}

}  // namespace
}  // namespace ninefold
