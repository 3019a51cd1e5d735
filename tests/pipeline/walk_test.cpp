// Light that is used again while the camera walks (common/image/irradiance_history.h): what it does
// to the error of a session's frames, and what it does that such frames look through the middle of
// each pixel. The frames are made as a session makes them, random bits fixed. The reference is a
// mean of other frames from the last place. docs/performance.md keeps the figures.
#include <gtest/gtest.h>

#include "common/image/metrics.h"
#include "common/scene/reader.h"
#include "master/running/light_cameras.h"
#include "master/running/live_picture.h"
#include "tests/pipeline/one_process.h"

namespace ninefold {
namespace {

constexpr int kSteps = 12, kReference = 96;  // frames

Settings small(bool moving) {
  Settings settings;
  settings.width = 160, settings.height = 120;
  // As a LivePlan has it.
  settings.jitter = !moving;
  settings.caustics = moving ? Caustics::direct : Caustics::all;
  if (moving) settings.resampling /= 2, settings.cameraPoints /= 2;
  return settings;
}

// A step to the side, with a turn of the head.
Camera after(const Camera& start, int steps) {
  const auto t = static_cast<float>(steps);
  Camera camera = start;
  const Vec3 right = glm::normalize(glm::cross(start.forward, start.up));
  camera.eye += 0.03f * t * right;
  camera.forward = glm::normalize(start.forward + 0.02f * t * right);
  return camera;
}

class Session {
 public:
  explicit Session(bool reuses) : picture_({SurfaceTest::surface, 1, 10, reuses}) {}

  RgbImage shown(const GatheredFrame& frame) {
    LiveFrame plan;
    plan.moving = true;
    const std::vector<uint32_t> owners(frame.tasks.size(), 0);
    for (int tile = 0; tile < frame.view.shape.grid.tiles(); ++tile)
      picture_.finishTile(0, frame, plan, {}, owners, tile);
    picture_.frameDone();
    return picture_.image()->radiance;
  }

 private:
  LivePicture picture_;
};

RgbImage reference(const Tracer& tracer, const Camera& camera) {
  Settings settings = small(false);
  settings.seed = 100;
  testing::OneProcess process(tracer, settings, nullptr, camera);
  Film film(settings.width, settings.height, {.error = false});
  for (int i = 0; i < kReference; ++i) {
    film.addTile(0, 0, process.nextFrame());
    film.frameDone();
  }
  RgbImage mean;
  mean.reset(settings.width, settings.height);
  film.meanOfTile({0, 0, settings.width, settings.height}, mean);
  return mean;
}

struct Way {
  const char* scene;
  Method method;
};

class Walk : public ::testing::TestWithParam<Way> {};

TEST_P(Walk, LightUsedAgainAndTheMiddleOfPixelsLowerTheError) {
  const auto [name, method] = GetParam();
  const Scene scene = readScene(NINEFOLD_SCENES "/" + std::string(name) + ".glb");
  const Tracer tracer(scene, Isa::automatic);
  Settings middle = small(true);
  middle.method = method;
  Settings jittered = middle;
  jittered.jitter = true;
  const auto walk = [&](const Settings& settings, bool reuses, int first) {
    Session session(reuses);
    LightCameras light;
    RgbImage last;
    for (int step = 0; step < kSteps; ++step) {
      const Camera camera = after(scene.cameras.front(), step);
      const std::vector<Camera>& cameras = light.next(camera);
      if (step < first) continue;
      testing::OneProcess process(tracer, settings, nullptr, camera);
      process.setLightCameras(cameras);
      GatheredFrame& frame = process.trace();
      frame.view.key.frame = static_cast<uint32_t>(step);
      last = session.shown(frame);
    }
    return last;
  };
  const RgbImage truth = reference(tracer, after(scene.cameras.front(), kSteps - 1));
  const auto errorOf = [&](const RgbImage& image) {
    return compareImages(image, truth).relMseTrimmed;
  };
  const RgbImage reused = walk(middle, true, 0), alone = walk(middle, false, kSteps - 1);
  const double torn = errorOf(walk(jittered, false, kSteps - 1));
  std::printf("%-10s %-17s relMSE trimmed: %.4f jittered, %.4f alone, %.4f with light used again\n",
              name, factsOf(method).name, torn, errorOf(alone), errorOf(reused));
  EXPECT_LT(errorOf(alone), torn);
  EXPECT_LT(errorOf(reused), 0.95 * errorOf(alone));
  const Metrics a = compareImages(reused, truth), b = compareImages(alone, truth);
  // The mean of one frame errs by 2.4 % where light is made for the view.
  const double apart = factsOf(method).lightNeedsView ? 0.03 : 0.02;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.bias[c], b.bias[c], apart) << "channel " << c;
}

INSTANTIATE_TEST_SUITE_P(Of, Walk,
                         ::testing::Values(Way{"table_room", Method::instantRadiosity},
                                           Way{"office", Method::instantRadiosity},
                                           Way{"table_room", Method::bidirectional}),
                         [](const auto& way) {
                           std::string name = way.param.scene + std::string("_by_");
                           name += factsOf(way.param.method).name;
                           std::ranges::replace(name, '-', '_');  // as test names must be
                           return name;
                         });

}  // namespace
}  // namespace ninefold
