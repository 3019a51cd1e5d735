// v x y z r g b: colours as a screen shows them, which the scene has linear. sRGB 0.5 is 0.2140.
#include "tests/scene/obj_folder.h"

namespace ninefold {
namespace {

using ObjVertexColour = ObjFolder;

const std::string kColoured = "v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 0 1 0 0 0 1\nv 1 1 0\n";

void expectNear(Vec4 a, Vec4 b) {
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(a[c], b[c], 1e-4f);
}

TEST_F(ObjVertexColour, AreReadLinear) {
  const Scene scene = read(kColoured + "f 1 2 3\nf 2 4 3\n");
  const std::vector<Vec4>& colours = scene.meshes[0].colors;
  ASSERT_EQ(colours.size(), 4u);
  expectNear(colours[0], Vec4(1, 0, 0, 1));
  expectNear(colours[1], Vec4(0, 0.2140f, 0, 1));
  expectNear(colours[2], Vec4(0, 0, 1, 1));
  expectNear(colours[3], Vec4(1));
  EXPECT_EQ(scene.materials[0].baseColor, Vec3(1)) << "no material: the colours as they are";
}

TEST_F(ObjVertexColour, MultiplyTheMaterials) {
  folder.write("a.mtl", "newmtl m\nKd 0.5 0.5 0.5\n");
  const Scene scene = read("mtllib a.mtl\n" + kColoured + "usemtl m\nf 1 2 3\n");
  EXPECT_EQ(scene.materials[0].baseColor, Vec3(0.5f));
  EXPECT_EQ(scene.meshes[0].colors.size(), 3u);
}

TEST_F(ObjVertexColour, FourthNumberIsAWeightSeventhAnOpacity) {
  const std::string square = "v 1 0 0\nv 1 1 0\nf 1 2 3\n";
  EXPECT_TRUE(read("v 0 0 0 0.5\n" + square).meshes[0].colors.empty());
  EXPECT_TRUE(read("v 0 0 0 1\n" + square).meshes[0].colors.empty());
  EXPECT_TRUE(read("v 0 0 0 1 0.5\n" + square).meshes[0].colors.empty());
  EXPECT_EQ(read("v 0 0 0 1 0 0 0.5\n" + square).meshes[0].colors[0], Vec4(1, 0, 0, 1));
  EXPECT_CONTAINS(logOfFile("v 0 0 0 1 0 0 0.5\n" + square), "opacity of v (line 1)");
  EXPECT_CONTAINS(logOfFile("v 0 0 0 1 0.5\n" + square), "further numbers of v (line 1)");
}

TEST_F(ObjVertexColour, BeyondTheirRangeAreClampedAndNamed) {
  const std::string text = "v 0 0 0 255 -1 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n";
  EXPECT_EQ(read(text).meshes[0].colors[0], Vec4(1, 0, 0, 1));
  EXPECT_CONTAINS(logOfFile(text), "colours of v beyond 0 to 1 (line 1)");
}

TEST_F(ObjVertexColour, InCommentsAreNamed) {
  EXPECT_CONTAINS(logOfFile(kSquare + "#MRGB ff808080ff808080\nf 1 2 3\n"), "#MRGB (line 9)");
}

TEST_F(ObjVertexColour, AreNotThereIfNobodyHasOne) {
  EXPECT_TRUE(read(kColoured + kSquare + "f 5 6 7\n").meshes[0].colors.empty());
}

}  // namespace
}  // namespace ninefold
