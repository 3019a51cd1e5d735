// How large an intersection field becomes is told before it is made, whole: lines, what nodes keep
// of them, and maps of lamps; at the start and after an edit.
#include "common/gi/intersection_field/field_size.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "common/gi/intersection_field/intersection_field.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A room with a lamp, a ball and a box.
Scene roomOf() {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.5f)));
  b.box(grey, Vec3(-1, -1, -1.3f), Vec3(1, 1.1f, 1), true);
  b.sphere(grey, Vec3(-0.3f, 0.1f, 0.2f), 0.4f, 10);
  b.box(grey, Vec3(-0.2f), Vec3(0.2f, 0.3f, 0.1f), false);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(5))), Vec3(0, 0.9f, 0), Vec3(0.3f, 0, 0),
         Vec3(0, 0, 0.3f));
  b.camera(Vec3(0, 0, 0.9f), Vec3(0, -0.3f, -1), 1);
  return b.build();
}

Settings fieldOf(int directions, int distances, FieldDirect direct) {
  Settings s = testing::small(Method::intersectionField);
  s.fieldDirections = directions, s.fieldDistances = distances, s.fieldDirect = direct;
  return s;
}

struct Made {
  Scene scene;
  Tracer tracer;
  Transport transport;
  IntersectionField method;
  Made(const Scene& its, const Settings& settings, const Made* begun = nullptr)
      : scene(its),
        tracer(scene, Isa::automatic),
        transport(tracer, settings, begun == nullptr ? nullptr : &begun->transport),
        method(transport, begun == nullptr ? nullptr : &begun->method) {}
};

std::string refusalOf(const Scene& scene, const Settings& settings, const Made* begun = nullptr) {
  try {
    const Made made(scene, settings, begun);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(FieldSize, IsToldBeforeWithinAFewPercent) {
  const Scene scene = roomOf();
  for (const FieldDirect direct : {FieldDirect::vpls, FieldDirect::field})
    for (const auto& [directions, distances] : {std::pair(9, 16), std::pair(19, 32)}) {
      const Settings settings = fieldOf(directions, distances, direct);
      const Made made(scene, settings);
      const SceneElements elements(StillScene(made.tracer, nullptr),
                                   settings.elementSize * made.transport.radius, nullptr);
      const size_t lamps = direct == FieldDirect::field ? 1 : 0;
      const auto bytes = static_cast<double>(made.method.bytes());
      EXPECT_NEAR(fieldBytes(made.method.field().grid(), {scene, scene.bounds, elements, lamps}),
                  bytes, 0.05 * bytes);
    }
}

TEST(FieldSize, RefusesWhatIsTooLargeAndTellsWhatFits) {
  const Scene scene = roomOf();
  Settings s = fieldOf(40, 63, FieldDirect::field);
  s.maxFieldMemory = 24;
  const std::string said = refusalOf(scene, s);
  int directions = 0, distances = 0;
  const size_t at = said.find("use --field-directions");
  ASSERT_NE(at, std::string::npos) << said;
  ASSERT_EQ(std::sscanf(said.c_str() + at, "use --field-directions %d --field-distances %d",
                        &directions, &distances),
            2);
  s.fieldDirections = directions, s.fieldDistances = distances;
  EXPECT_GT(directions, 10);
  EXPECT_EQ(refusalOf(scene, s), "");
  EXPECT_LT(Made(scene, s).method.bytes(), size_t{25} << 20);
}

// What nodes keep does not get less with fewer lines than they ask for.
TEST(FieldSize, SaysWhereNoResolutionFits) {
  Settings s = fieldOf(19, 32, FieldDirect::field);
  s.maxFieldMemory = 1, s.elementSize = 0.01f;
  const std::string said = refusalOf(roomOf(), s);
  EXPECT_NE(said.find("--max-field-memory is 1: raise it, or use --element-size larger"),
            std::string::npos)
      << said;
}

// A thing that an edit makes large takes more lines.
TEST(FieldSize, BoundsWhatAnEditMakes) {
  const Scene scene = roomOf();
  Settings s = fieldOf(27, 46, FieldDirect::vpls);
  Scene grown = scene;
  grown.instances[1].toWorld[0][0] = grown.instances[1].toWorld[1][1] = 2;
  const size_t small = Made(scene, s).method.bytes(), large = Made(grown, s).method.bytes();
  ASSERT_GT(large, small + (size_t{2} << 20));
  s.maxFieldMemory = static_cast<int>((small + large) >> 21);
  const Made begun(scene, s);
  EXPECT_EQ(refusalOf(scene, s, &begun), "");
  EXPECT_NE(refusalOf(grown, s, &begun).find("the intersection field would take"),
            std::string::npos);
}

}  // namespace
}  // namespace ninefold
