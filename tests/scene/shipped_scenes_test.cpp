#include <gtest/gtest.h>

#include <filesystem>

#include "common/scene/emitters.h"
#include "common/scene/reader.h"

namespace ninefold {
namespace {

TEST(ShippedScenes, LoadWithCameraAndLight) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(NINEFOLD_SCENES)) {
    if (entry.path().extension() != ".glb") continue;
    const Scene scene = readScene(entry.path());
    EXPECT_NE(scene.cameras[0].name, "framing") << entry.path();
    EXPECT_EQ(scene.environment, Radiance(0)) << entry.path();
    EXPECT_FALSE(Emitters(scene, Radiance(0)).empty()) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 7);
}

}  // namespace
}  // namespace ninefold
