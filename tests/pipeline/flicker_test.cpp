// How much a moving sequence flickers, with the random bits and sample streams of a gesture fixed
// and with other bits for each frame. I_t are its frames; R_t is the same state as a mean of more
// frames, with bits of their own:
//
//   e_t = (I_t+1 - I_t) - (R_t+1 - R_t)      flicker = sqrt(mean of e_t^2) / mean of R_t, luminance
//
// e_t is what a frame adds to the change that is there. docs/performance.md keeps the figures.
#include <gtest/gtest.h>

#include "common/scene/edit.h"
#include "common/scene/reader.h"
#include "tests/pipeline/one_process.h"

namespace ninefold {
namespace {

constexpr int kSteps = 4, kReference = 12;  // states; frames of R

std::vector<double> luminances(const RgbImage& image) {
  std::vector<double> values(image.count());
  for (size_t i = 0; i < values.size(); ++i) values[i] = double(luminance(image.rgb(i)));
  return values;
}

std::vector<double> frames(const Tracer& tracer, uint64_t seed, int count,
                           const Tracer* begun = nullptr) {
  Settings settings;
  settings.width = 80, settings.height = 60, settings.seed = seed;
  testing::OneProcess process(tracer, settings, begun);
  std::vector<double> mean(80 * 60, 0);
  for (int frame = 0; frame < count; ++frame) {
    const std::vector<double> values = luminances(process.nextFrame());
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += values[i] / count;
  }
  return mean;
}

struct Flicker {
  double fixed, free;
};

// state(t): the edits of the scene at step t.
template <typename State>
Flicker flickerOf(const Scene& scene, const State& state) {
  std::vector<std::vector<double>> fixed, free, reference;
  const Scene first = edited(scene, state(0));
  const Tracer begun(first, Isa::automatic);
  for (uint64_t t = 0; t < kSteps; ++t) {
    const Scene now = edited(scene, state(static_cast<double>(t)));
    const Tracer tracer(now, Isa::automatic);
    fixed.push_back(frames(tracer, 1, 1, t == 0 ? nullptr : &begun));
    free.push_back(frames(tracer, 1 + t, 1));
    reference.push_back(frames(tracer, 100, kReference));
  }
  double mean = 0;
  for (const double L : reference[0]) mean += L / static_cast<double>(reference[0].size());
  const auto rms = [&](const auto& sequence) {
    double sum = 0;
    for (size_t t = 0; t + 1 < kSteps; ++t)
      for (size_t i = 0; i < sequence[t].size(); ++i) {
        const double e =
            sequence[t + 1][i] - sequence[t][i] - reference[t + 1][i] + reference[t][i];
        sum += e * e;
      }
    return std::sqrt(sum / static_cast<double>((kSteps - 1) * sequence[0].size())) / mean;
  };
  return {rms(fixed), rms(free)};
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

}  // namespace
}  // namespace ninefold
