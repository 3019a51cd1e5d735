// A value that is no number, from the task that makes it to the finished frame: an environment of
// NaN, which neither files nor the wire let in, makes the U of each pixel NaN that meets it. Such a
// pixel becomes black, its neighbours do not, and the result says how many values and in which
// field.
#include <gtest/gtest.h>

#include <cmath>

#include "client/render_job.h"
#include "common/gi/light_check.h"
#include "common/gi/radiosity/radiosity.h"
#include "master/assembly/assembly.h"
#include "master/assembly/picture.h"
#include "proto/tile_names.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {
namespace {

// A lamp of radiance 1 before an environment of NaN.
std::shared_ptr<const Scene> lampOnNothing() {
  Scene scene = simpleScene();
  scene.materials[0].emission = Vec3(1);
  scene.materials[0].baseColor = Vec3(0);
  return std::make_shared<const Scene>(std::move(scene));
}

Settings oddSky() {
  Settings s;
  s.width = 96, s.height = 72, s.jitter = false;
  s.camera.eye = Vec3(0.5f, 0.5f, 2), s.camera.forward = Vec3(0, 0, -1),
  s.camera.up = Vec3(0, 1, 0);
  s.environment = Vec3(NAN);
  return s;
}

// The eye's ray meets the lamp: the unit square in z = 0.
bool seesLamp(const Settings& s, int x, int y) {
  const CameraRays rays(s.camera, s.width, s.height);
  const Vec3 d = rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const Vec3 p = s.camera.eye - (s.camera.eye.z / d.z) * d;
  return p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1;
}

// A frame from the client's job over the wire's bytes to the master's assembly.
class OneFrame {
 public:
  OneFrame(const Settings& settings, Delivery::Form form)
      : settings_(settings),
        delivery_{.form = form},
        job_(std::make_shared<TracedScene>(lampOnNothing(), Isa::avx2), 1, settings, delivery_, 1),
        assembly_(
            1,
            [](ReceivedTile&&, const std::optional<std::string>& bad) {
              EXPECT_EQ(bad, std::nullopt);
            },
            [this](int, const GatheredFrame& frame, int tile) { finish(frame, tile); }) {
    beauty.reset(settings.width, settings.height);
    FrameView view;
    view.shape = {grid_, form == Delivery::Form::layers ? kDiffuseBit : kRadianceMask, 0};
    view.camera = settings.camera;
    assembly_.open(view);
    const int phases = delivery_.wholeTiles() ? 1 : settings.interleave.sets();
    for (int tile = 0; tile < grid_.tiles(); ++tile)
      for (int phase = 0; phase < phases; ++phase) send(tile, phase);
    EXPECT_TRUE(assembly_.next(Clock::now() + std::chrono::seconds(30)));
  }

  RgbImage beauty;
  Replaced replaced;

 private:
  void send(int tile, int phase) {
    const msg::TaskItem item{static_cast<uint32_t>(tile), static_cast<uint32_t>(phase), 0};
    RenderJob::Done done = job_.run({}, item, 1, 1, 0, [] { return Time{}; });
    const Message arrived = decodeMessage(encodeMessage(std::move(done.result)), Peer::client);
    ReceivedTile received{1, std::get<msg::Result>(arrived), Time{}};
    replaced += {received.result.replaced, received.result.replacedIn};
    EXPECT_TRUE(assembly_.take(received));
  }
  // As picture.cpp and live_picture.cpp do.
  void finish(const GatheredFrame& frame, int tile) {
    RgbImage part;
    if (delivery_.wholeTiles()) {
      frame.task(tile, 0).copyRadiance(part);
    } else {
      gather(frame, tile, patch_);
      filter_.compose(patch_, settings_.camera, 1, part);
    }
    const int side = kTaskSide * settings_.interleave.n, columns = settings_.width / side;
    for (int y = 0; y < part.height; ++y)
      for (int x = 0; x < part.width; ++x) {
        const size_t to = beauty.at(tile % columns * side + x, tile / columns * side + y);
        const Vec3 value = part.rgb(part.at(x, y));
        beauty.pixels.r[to] = value.x, beauty.pixels.g[to] = value.y, beauty.pixels.b[to] = value.z;
      }
  }

  const Settings settings_;
  const Delivery delivery_;
  const TileGrid grid_{settings_.width, settings_.height, settings_.interleave};
  RenderJob job_;
  Patch patch_;
  PatchFilter filter_{SurfaceTest::surface};
  Assembly assembly_;
};

#ifdef NDEBUG

TEST(NotFinite, APixelIsBlackItsNeighboursAreNotAndTheResultSaysSo) {
  const Settings s = oddSky();
  for (const auto form : {Delivery::Form::layers, Delivery::Form::radiance}) {
    SCOPED_TRACE(static_cast<int>(form));
    const OneFrame frame(s, form);
    uint64_t sky = 0;
    for (int y = 0; y < s.height; ++y)
      for (int x = 0; x < s.width; ++x) {
        const bool lamp = seesLamp(s, x, y);
        sky += lamp ? 0 : 1;
        ASSERT_EQ(frame.beauty.rgb(frame.beauty.at(x, y)), Vec3(lamp ? 1 : 0)) << x << "," << y;
      }
    ASSERT_GT(sky, 0u);
    // Pixels in the border of whole tiles are made twice.
    EXPECT_GE(frame.replaced.count, 3 * sky);
    EXPECT_LE(frame.replaced.count, (form == Delivery::Form::layers ? 1 : 2) * 3 * sky);
    EXPECT_EQ(namesOfFields(frame.replaced.fields), "U (diffuse)");
  }
}

#else

TEST(NotFiniteDeathTest, IsFatalWhereItIsMade) {
  EXPECT_DEATH(OneFrame(oddSky(), Delivery::Form::layers),
               "diffuse layer: U is \\(nan.*frame 0, tile 0, phase 0; ninefold-replay-task SCENE");
}

#endif

TEST(LightCheckDeathTest, NamesTheValueThePlaceAndTheCommand) {
  const Scene scene = simpleScene();
  Settings s;
  s.camera = scene.cameras[0], s.seed = 77;
  TileResult tile;
  tile.reset(2, 2, kDiffuseBit, 0);
  Task task;
  task.frame.frame = 3, task.tile = 5, task.phase = 2;
  checkLight(tile, task, scene, s);
  tile.layers[0].irradiance.g[1] = INFINITY;
  EXPECT_DEATH(
      checkLight(tile, task, scene, s),
      "diffuse layer: E is \\(0, inf, 0\\) at the task's pixel 1, frame 3, tile 5, phase 2; "
      "ninefold-replay-task SCENE --frame 3:0:0:.* --tile 5 --phase 2 .*--seed 77[ )]");
  LightSet lights;
  lights.vpls.resize(2);
  checkLight(lights, task.frame, 4, scene, s);
  lights.vpls[1].power.x = NAN;
  EXPECT_DEATH(checkLight(lights, task.frame, 4, scene, s), "VPL 1 .*frame 3, set 4");
}

}  // namespace
}  // namespace ninefold
