// The scene three_turns: light makes three bounces or more before it comes into the room, so that a
// path to what the camera sees has four diffuse vertices at least.
#include <gtest/gtest.h>

#include "common/scene/reader.h"
#include "tests/gi/expect.h"

namespace ninefold {
namespace {

Settings ofLength(Method method, int length) {
  Settings s = testing::small(method, 16);
  s.interleave = {1, 1}, s.pathLength = length;
  s.indirectVpls = 256;  // paths with just three bounces are rare
  return s;
}

TEST(ThreeTurns, IsBlackUntilLightMayBounceThreeTimes) {
  const Scene scene = readScene(NINEFOLD_SCENES "/three_turns.glb");
  const Tracer tracer(scene, Isa::automatic);
  for (const MethodFacts& facts : allMethods()) {
    if (facts.isChoice) continue;
    if (facts.bias != nullptr) continue;  // a pool's light leaks under walls, as wide as its disks
    EXPECT_EQ(testing::render(tracer, ofLength(facts.method, 3), 20).grey(), 0) << facts.name;
  }
  EXPECT_GT(testing::render(tracer, ofLength(Method::bidirectional, 4), 100).grey(), 0);
}

}  // namespace
}  // namespace ninefold
