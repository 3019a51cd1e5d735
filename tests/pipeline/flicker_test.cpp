// How much a moving sequence flickers, with the random bits and sample streams of a gesture fixed
// and with other bits for each frame. I_t are its frames; R_t is the same state as a mean of more
// frames, with bits of their own:
//
//   e_t = (I_t+1 - I_t) - (R_t+1 - R_t)      flicker = sqrt(mean of e_t^2) / mean of R_t, luminance
//
// e_t is what a frame adds to the change that is there. docs/performance.md keeps the figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "common/scene/edit.h"
#include "common/scene/reader.h"
#include "master/running/light_cameras.h"
#include "tests/pipeline/one_process.h"

namespace ninefold {
namespace {

constexpr int kSteps = 4, kReference = 12;  // states; frames of R

std::vector<double> luminances(const RgbImage& image) {
  std::vector<double> values(image.count());
  for (size_t i = 0; i < values.size(); ++i) values[i] = double(luminance(image.rgb(i)));
  return values;
}

using Sequence = std::vector<std::vector<double>>;  // luminances, by state and pixel

constexpr int kWidth = 80, kHeight = 60;

// The mean of the process's next frames.
std::vector<double> frames(testing::OneProcess& process, int count) {
  std::vector<double> mean(kWidth * kHeight, 0);
  for (int frame = 0; frame < count; ++frame) {
    const std::vector<double> values = luminances(process.nextFrame());
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += values[i] / count;
  }
  return mean;
}

std::vector<double> frames(const Tracer& tracer, uint64_t seed, int count,
                           const Tracer* begun = nullptr) {
  Settings settings;
  settings.width = kWidth, settings.height = kHeight, settings.seed = seed;
  testing::OneProcess process(tracer, settings, begun);
  return frames(process, count);
}

// e_t^2 / mean^2 of all states and pixels.
std::vector<double> squares(const Sequence& sequence, const Sequence& reference) {
  double mean = 0;
  for (const double L : reference[0]) mean += L / static_cast<double>(reference[0].size());
  std::vector<double> all;
  for (size_t t = 0; t + 1 < sequence.size(); ++t)
    for (size_t i = 0; i < sequence[t].size(); ++i) {
      const double e = sequence[t + 1][i] - sequence[t][i] - reference[t + 1][i] + reference[t][i];
      all.push_back(e * e / (mean * mean));
    }
  return all;
}

double rms(const std::vector<double>& squares) {
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

struct Flicker {
  double fixed, free;
};

// state(t): the edits of the scene at step t.
template <typename State>
Flicker flickerOf(const Scene& scene, const State& state) {
  Sequence fixed, free, reference;
  const Scene first = edited(scene, state(0));
  const Tracer begun(first, Isa::automatic);
  for (uint64_t t = 0; t < kSteps; ++t) {
    const Scene now = edited(scene, state(static_cast<double>(t)));
    const Tracer tracer(now, Isa::automatic);
    fixed.push_back(frames(tracer, 1, 1, t == 0 ? nullptr : &begun));
    free.push_back(frames(tracer, 1 + t, 1));
    reference.push_back(frames(tracer, 100, kReference));
  }
  return {rms(squares(fixed, reference)), rms(squares(free, reference))};
}

int nodeNamed(const Scene& scene, const std::string& name) {
  return std::ranges::find(scene.instances, name, &Instance::name)->node;
}

SceneEdit moved(const Scene& scene, const std::string& name, DVec3 by) {
  SceneEdit edit;
  edit.objects.push_back({nodeNamed(scene, name), DMat4(1)});
  edit.objects[0].motion[3] = DVec4(by, 1);
  return edit;
}

Scene tableRoom() { return readScene(NINEFOLD_SCENES "/table_room.glb"); }

void tell(const char* what, const Flicker& flicker) {
  std::printf("%-40s fixed bits %5.2f %%   free bits %5.2f %%\n", what, 100 * flicker.fixed,
              100 * flicker.free);
}

TEST(FlickerOfASequence, AMovedThing) {
  const Scene scene = tableRoom();
  const Flicker books =
      flickerOf(scene, [&](double t) { return moved(scene, "books", DVec3(0.03 * t, 0, 0)); });
  tell("books go 3 cm a frame", books);
  EXPECT_LT(books.fixed, 0.3 * books.free);
}

TEST(FlickerOfASequence, AMovedGlass) {
  const Scene scene = tableRoom();
  const Flicker glass = flickerOf(
      scene, [&](double t) { return moved(scene, "glass sphere", DVec3(-0.03 * t, 0, 0)); });
  tell("a glass sphere goes 3 cm a frame", glass);
  EXPECT_LT(glass.fixed, 0.6 * glass.free);
}

TEST(FlickerOfASequence, OneOfTwoLampsDims) {
  Scene scene = tableRoom();
  PunctualLight spot;
  spot.kind = LightKind::spot, spot.position = Vec3(0, 0.9f, 0.5f), spot.direction = Vec3(0, -1, 0);
  spot.intensity = Vec3(4);
  scene.lights.push_back(spot);
  const Flicker lamp = flickerOf(scene, [&](double t) {
    SceneEdit edit;
    edit.lights.push_back(editOf(scene, 0));
    edit.lights[0].intensity *= static_cast<float>(1 - 0.1 * t);
    return edit;
  });
  tell("a spot beside the lamp dims by a tenth", lamp);
  EXPECT_LT(lamp.fixed, 0.2 * lamp.free);
}

// A walk of `pace` metres a frame to the side, with a turn of the head of two thirds of a radian a
// metre.
Camera walked(const Camera& start, float pace, int steps) {
  const float way = pace * static_cast<float>(steps);
  Camera camera = start;
  const Vec3 right = glm::normalize(glm::cross(start.forward, start.up));
  camera.eye += way * right;
  camera.forward = glm::normalize(start.forward + way / 1.5f * right);
  return camera;
}

// Of frames as a LivePlan has them. It is told without the worst thousandth of e_t^2, too: a VPL
// where few camera points look shows as a spot in few pixels.
struct WalkFlicker {
  double all, trimmed;
};

class WalkOf {
 public:
  static constexpr int kSteps = 8;
  enum class Light { ownView, lastViews };

  WalkOf(const std::string& scene, float pace)
      : scene_(readScene(NINEFOLD_SCENES "/" + scene + ".glb")),
        tracer_(scene_, Isa::automatic),
        pace_(pace) {
    for (int t = 0; t < kSteps; ++t)
      reference_.push_back(framesAt(t, Method::bidirectional, 100, kReference, {}));
  }

  WalkFlicker flicker(Method method, Light light) const {
    LightCameras cameras;
    Sequence sequence;
    for (int t = 0; t < kSteps; ++t) {
      const std::vector<Camera>& last = cameras.next(cameraAt(t));
      sequence.push_back(
          framesAt(t, method, 1, 1, light == Light::ownView ? std::vector<Camera>() : last));
    }
    std::vector<double> e = squares(sequence, reference_);
    const double all = rms(e);
    std::sort(e.begin(), e.end());
    std::fill(e.end() - static_cast<ptrdiff_t>(e.size() / 1000), e.end(), 0.0);
    return {all, rms(e)};
  }

 private:
  Camera cameraAt(int t) const { return walked(scene_.cameras.front(), pace_, t); }
  std::vector<double> framesAt(int t, Method method, uint64_t seed, int count,
                               const std::vector<Camera>& lightCameras) const {
    Settings settings;
    settings.method = method, settings.width = kWidth, settings.height = kHeight;
    settings.seed = seed, settings.jitter = false, settings.caustics = Caustics::direct;
    settings.resampling /= 2, settings.cameraPoints /= 2;
    testing::OneProcess process(tracer_, settings, nullptr, cameraAt(t));
    process.setLightCameras(lightCameras);
    return frames(process, count);
  }

  const Scene scene_;
  const Tracer tracer_;
  const float pace_;
  Sequence reference_;
};

struct Way {
  const char* scene;
  int millimetres;  // a frame
};

class FlickerOfAWalk : public ::testing::TestWithParam<Way> {};

// Methods whose light is made for a view flicker at most twice as much as the standard one.
TEST_P(FlickerOfAWalk, IsAtMostTwiceAsMuchWhereLightNeedsTheView) {
  const auto [scene, millimetres] = GetParam();
  const WalkOf walk(scene, 0.001f * static_cast<float>(millimetres));
  const auto tell = [&](const char* what, const WalkFlicker& f) {
    std::printf("%-10s %2d mm a frame  %-34s %6.1f %%, trimmed %6.1f %%\n", scene, millimetres,
                what, 100 * f.all, 100 * f.trimmed);
  };
  const WalkFlicker standard = walk.flicker(Settings{}.method, WalkOf::Light::ownView);
  tell("standard", standard);
  for (const MethodFacts& facts : allMethods()) {
    if (!facts.lightNeedsView || facts.isChoice) continue;
    const WalkFlicker own = walk.flicker(facts.method, WalkOf::Light::ownView);
    const WalkFlicker last = walk.flicker(facts.method, WalkOf::Light::lastViews);
    tell((std::string(facts.name) + ", own view").c_str(), own);
    tell((std::string(facts.name) + ", last views").c_str(), last);
    EXPECT_LT(last.trimmed, 2 * standard.trimmed) << facts.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Along, FlickerOfAWalk,
                         ::testing::Values(Way{"table_room", 3}, Way{"table_room", 30},
                                           Way{"u_office", 3}, Way{"u_office", 30}),
                         [](const auto& way) {
                           return std::string(way.param.scene) + "_" +
                                  std::to_string(way.param.millimetres) + "mm";
                         });

}  // namespace
}  // namespace ninefold
