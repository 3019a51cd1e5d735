// Blender's first scene, exported by its own exporter (tests/scene/blender_default.py), beside
// Cycles: a cube, a lamp of 1,000 W, a camera; a black world, as glTF has none. Expected: means of
// two faces of the cube in the picture that Cycles made of it with 1,024 samples, green channel.
// Both renderers agree on the diffuse part. Their gloss (roughness 0.5) is not the same model,
// hence the 10 %.
#include "common/scene/reader.h"
#include "tests/gi/expect.h"

namespace ninefold {
namespace {

struct Face {
  const char* name;
  int x0, y0, x1, y1;  // in a picture of 480x270
  double cycles;
};

double meanOf(const testing::Rendered& image, const Face& face, int scale) {
  double sum = 0;
  int count = 0;
  for (int y = face.y0 / scale; y < face.y1 / scale; ++y)
    for (int x = face.x0 / scale; x < face.x1 / scale; ++x, ++count)
      sum += double{image.pixels[static_cast<size_t>(y * image.width + x)].y};
  return sum / count;
}

TEST(Blender, ItsFirstSceneLooksAsCyclesShowsIt) {
  const Scene scene = readScene(NINEFOLD_SCENES "/../tests/scene/blender_default.glb");
  const Tracer tracer(scene, Isa::automatic);
  constexpr int kScale = 3;
  for (const Method method : {Method::instantRadiosity, Method::pathTrace}) {
    Settings s = testing::small(method);
    s.width = 480 / kScale, s.height = 270 / kScale;
    const auto image = testing::render(tracer, s, 16);
    for (const Face& face :
         {Face{"top", 204, 72, 270, 93, 0.39495}, Face{"right", 252, 120, 312, 189, 0.20570}})
      EXPECT_NEAR(meanOf(image, face, kScale), face.cycles, 0.1 * face.cycles) << face.name;
    EXPECT_EQ(meanOf(image, {"left", 180, 108, 222, 165, 0}, kScale), 0) << "away from the lamp";
  }
}

}  // namespace
}  // namespace ninefold
