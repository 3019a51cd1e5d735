#include "common/image/frame_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/base/error.h"
#include "tests/image/synthetic.h"

namespace ninefold {
namespace {

using namespace synthetic;

constexpr uint8_t kAllLayers = kDiffuseBit | kReflectionBit | kTransmissionBit;
constexpr uint8_t kAllExtras =
    kAlbedoPlane | kNormalPlane | kDepthPlane | kObjectPlane | kCausticPlane;

uint32_t codeOf(int x, int y) { return static_cast<uint32_t>(1 + x + 1000 * y); }

FrameBuffer codedFrame(const TileGrid& grid) {
  return frameOf(grid, kAllLayers, kAllExtras, [](TileResult& out, size_t i, int x, int y) {
    const float code = static_cast<float>(codeOf(x, y));
    out.layers[kTransmission].unfiltered.b[i] = code;
    out.layers[kReflection].chain[i] = static_cast<uint16_t>(codeOf(x, y));
    out.extras.caustic.g[i] = code;
    out.extras.object[i] = codeOf(x, y);
  });
}

TEST(FrameBuffer, PutsEveryPixelWhereItBelongs) {
  for (const Case& c : kCases) {
    const TileGrid grid(c.width, c.height, c.pattern);
    const FrameBuffer frame = codedFrame(grid);
    for (int y = 0; y < c.height; ++y)
      for (int x = 0; x < c.width; ++x) {
        const TileResult& phase = frame.phase(grid.phaseOfPixel(x, y));
        const size_t at = subIndex(grid, x, y);
        ASSERT_EQ(phase.layers[kTransmission].unfiltered.b[at], codeOf(x, y));
        ASSERT_EQ(phase.layers[kReflection].chain[at], static_cast<uint16_t>(codeOf(x, y)));
        ASSERT_EQ(phase.extras.caustic.g[at], codeOf(x, y));
        ASSERT_EQ(phase.extras.object[at], codeOf(x, y));
      }
  }
}

TEST(FrameBuffer, HoldsOnlyThePlanesThatWereAskedFor) {
  const FrameBuffer frame(TileGrid(40, 30, {3, 3}), kDiffuseBit | kTransmissionBit, kDepthPlane);
  const TileResult& phase = frame.phase(4);
  EXPECT_TRUE(phase.layers[kReflection].distance.empty());
  EXPECT_FALSE(phase.layers[kTransmission].distance.empty());
  EXPECT_TRUE(phase.extras.object.empty());
  EXPECT_FALSE(phase.extras.depth.empty());
}

TEST(FrameBuffer, RefusesResultsOfAnotherShapeAndStaysAsItWas) {
  const TileGrid grid(200, 100, {3, 3});
  FrameBuffer frame = codedFrame(grid);
  const TileResult before = frame.phase(0);
  const TaskRect rect = grid.rect(0, 0);
  TileResult wrong;
  const auto refused = [&] { EXPECT_THROW(frame.place(0, 0, wrong), Error); };
  wrong.reset(rect.width, rect.height - 1, kAllLayers, kAllExtras), refused();
  wrong.reset(rect.height, rect.width + 1, kAllLayers, kAllExtras), refused();
  wrong.reset(rect.width, rect.height, kDiffuseBit, kAllExtras), refused();
  wrong.reset(rect.width, rect.height, kAllLayers, kDepthPlane), refused();
  wrong.reset(rect.width, rect.height, kAllLayers, kAllExtras);
  wrong.layers[kReflection].normal.g.pop_back(), refused();
  wrong.reset(rect.width, rect.height, kAllLayers, kAllExtras);
  wrong.extras.object.clear(), refused();
  EXPECT_EQ(frame.phase(0).layers, before.layers);
  EXPECT_EQ(frame.phase(0).extras, before.extras);
}

TEST(FrameBuffer, KeepsItsMemoryFromFrameToFrame) {
  const TileGrid grid(100, 80, {3, 3}), smaller(90, 80, {3, 3});
  FrameBuffer frame = codedFrame(grid);
  const float* plane = frame.phase(5).layers[kDiffuse].irradiance.g.data();
  TileResult result;
  const TaskRect rect = grid.rect(0, 5);
  result.reset(rect.width, rect.height, kAllLayers, kAllExtras);
  frame.place(0, 5, result);
  EXPECT_EQ(frame.phase(5).layers[kDiffuse].irradiance.g.data(), plane);
  frame.reset(smaller, kAllLayers, kAllExtras);
  EXPECT_EQ(frame.phase(5).layers[kDiffuse].irradiance.g.data(), plane);
  EXPECT_TRUE(std::ranges::all_of(frame.phase(5).extras.object, [](uint32_t v) { return v == 0; }));
}

}  // namespace
}  // namespace ninefold
