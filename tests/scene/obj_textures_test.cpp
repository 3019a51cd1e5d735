// Maps of MTL materials as images. Texels are 8-bit codes; sRGB code 188 is linear 0.5029.
#include "tests/scene/obj_folder.h"

namespace ninefold {
namespace {

using Texels = std::vector<uint8_t>;
using ObjTextures = ObjFolder;

TEST_F(ObjTextures, ColoursMultiplyWhatIsUnderThem) {
  picture("wood.png", 1, 1, 3, {9, 8, 7});
  const Scene scene = square(
      "Kd 0 0 0\nmap_Kd wood.png\nmap_ke -clamp on wood.png\nMAP_KS wood.png\nmap_Ka gone.png\n");
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.baseColor, Vec3(1)) << "black under a map counts as white";
  EXPECT_EQ(m.emission, Vec3(1));
  EXPECT_EQ(m.specular, 1);
  EXPECT_EQ(m.emissionMap.wrapS, Wrap::clamp);
  EXPECT_EQ(m.emissionMap.image, m.baseColorMap.image);
  EXPECT_EQ(m.specularColorMap.image, m.baseColorMap.image);
  EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
  EXPECT_EQ(material("Kd 0.5 0.5 0.5\nmap_Kd wood.png\n").baseColor, Vec3(0.5f));
  EXPECT_EQ(material("map_Kd wood.png\n").baseColor, Vec3(1)) << "Blender leaves Kd out";
}

TEST_F(ObjTextures, OpacityIsCoverage) {
  picture("leaf.png", 2, 1, 3, {1, 2, 3, 4, 5, 6});
  picture("cut.png", 4, 1, 1, {255, 128, 1, 0});
  const Scene scene = square("Kd 1 1 1\nd 0.5\nmap_Kd leaf.png\nmap_d -s 1 1 cut.png\n");
  EXPECT_EQ(scene.materials[0].alphaMode, AlphaMode::blend);
  EXPECT_EQ(scene.materials[0].opacity, 0.5f);
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0].texels, (Texels{1, 2, 3, 255, 1, 2, 3, 128, 4, 5, 6, 1, 4, 5, 6, 0}));
}

// The colour once, the mask twice over the square; then the mask a half further to the left.
TEST_F(ObjTextures, MapsOfOtherCoordinatesShareASquare) {
  picture("one.png", 1, 1, 3, {1, 2, 3});
  picture("cut.png", 2, 1, 1, {255, 7});
  const auto alphas = [&](const std::string& options) {
    const Scene scene = square("Kd 1 1 1\nmap_Kd one.png\nmap_d " + options + " cut.png\n");
    EXPECT_EQ(scene.materials[0].baseColorMap.scale, Vec2(1));
    EXPECT_EQ(scene.materials[0].baseColorMap.offset, Vec2(0));
    Texels alpha;
    for (size_t i = 3; i < scene.images[0].texels.size(); i += 4)
      alpha.push_back(scene.images[0].texels[i]);
    return alpha;
  };
  EXPECT_EQ(alphas("-s 2 1"), (Texels{255, 7, 255, 7}));
  EXPECT_EQ(alphas("-o 0.5"), (Texels{7, 255}));
  EXPECT_EQ(alphas("-s -2 1"), (Texels{7, 255, 7, 255}));
}

TEST_F(ObjTextures, OpacityIsTheAlphaChannelIfThatSaysAnything) {
  picture("alpha.png", 2, 1, 4, {50, 60, 70, 0, 50, 60, 70, 77});
  picture("grey.png", 2, 1, 4, {51, 51, 51, 255, 200, 200, 200, 255});
  EXPECT_EQ(square("map_d alpha.png\n").images[0].texels,
            (Texels{255, 255, 255, 0, 255, 255, 255, 77}));
  EXPECT_EQ(square("map_d grey.png\n").images[0].texels,
            (Texels{255, 255, 255, 51, 255, 255, 255, 200}));
  EXPECT_EQ(square("map_d -imfchan g alpha.png\n").images[0].texels,
            (Texels{255, 255, 255, 60, 255, 255, 255, 60}));
}

TEST_F(ObjTextures, TheAlphaOfAColourIsNoOpacity) {
  picture("c.png", 1, 1, 4, {10, 20, 30, 40});
  const Scene scene = square("Kd 1 1 1\nd 0.5\nmap_Kd c.png\n");
  EXPECT_EQ(scene.images[0].texels, (Texels{10, 20, 30}));
  EXPECT_EQ(square("Kd 1 1 1\nmap_Kd c.png\n").materials[0].alphaMode, AlphaMode::opaque);
}

// linear' = base + gain linear; linear(188) = 0.5029, linear(0) = 0, linear(255) = 1. Base 0.5 and
// gain 0.25 give 0.6257, 0.5 and 0.75, whose largest, 0.75, becomes the factor: 0.8343, 0.6667 and
// 1, whose codes are 234.9, 212.8 and 255.
TEST_F(ObjTextures, BaseAndGainChangeColours) {
  picture("c.png", 1, 1, 3, {188, 0, 255});
  const Scene baked = square("Kd 1 1 1\nmap_Kd -mm 0.5 0.25 c.png\n");
  EXPECT_EQ(baked.images[0].texels, (Texels{235, 213, 255}));
  EXPECT_EQ(baked.materials[0].baseColor, Vec3(0.75f));
  const Scene factor = square("Kd 0.5 0.5 0.5\nmap_Kd -mm 0 0.5 c.png\n");
  EXPECT_EQ(factor.materials[0].baseColor, Vec3(0.25f));
  EXPECT_EQ(factor.images[0].texels, (Texels{188, 0, 255}));
  EXPECT_EQ(square("Kd 1 1 1\nmap_Kd -mm 0 1 c.png\n").images[0].texels, (Texels{188, 0, 255}));
  const Scene light = square("Kd 0 0 0\nmap_Ke -mm 0 10 c.png\n");
  EXPECT_EQ(light.materials[0].emission, Vec3(10));
  EXPECT_EQ(light.images[0].texels, (Texels{188, 0, 255}));
  EXPECT_EQ(square("Kd 0 0 0\nmap_Ke -mm 3 -1 c.png\n").materials[0].emission, Vec3(3));
}

TEST_F(ObjTextures, AChannelOfAColourIsGrey) {
  picture("c.png", 1, 1, 3, {10, 20, 30});
  EXPECT_EQ(square("map_Kd -imfchan b c.png\n").images[0].texels, (Texels{30, 30, 30}));
}

// glTF's: roughness in G, metallic in B; what has no map is 255, times its factor.
TEST_F(ObjTextures, RoughnessAndMetallic) {
  picture("r.png", 2, 1, 1, {64, 128});
  picture("m.png", 1, 1, 3, {200, 200, 200});
  const Scene both = square("Kd 1 1 1\nmap_Pr r.png\nmap_Pm -s 1 m.png\n");
  const Material& m = both.materials[0];
  EXPECT_EQ(imageOf(both, m.metallicRoughnessMap).texels, (Texels{255, 64, 200, 255, 128, 200}));
  EXPECT_FALSE(imageOf(both, m.metallicRoughnessMap).srgb);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.metallic, 1);
  const Scene rough = square("Kd 1 1 1\nPr 0.5\nmap_Pr -mm 0 0.5 r.png\n");
  EXPECT_EQ(imageOf(rough, rough.materials[0].metallicRoughnessMap).texels,
            (Texels{255, 32, 255, 255, 64, 255}));
  EXPECT_EQ(rough.materials[0].roughness, 0.5f);
  EXPECT_EQ(rough.materials[0].metallic, 0);
  EXPECT_CONTAINS(logOf("map_Pr r.png\nmap_Pm -s 1.5 2 m.png\n"),
                  "map_Pr and map_Pm have different -s, -o or -clamp");
}

TEST_F(ObjTextures, NormalMapsStayAsTheyAre) {
  picture("n.png", 1, 1, 3, {128, 128, 255});
  const Scene scene = square("norm -bm 0.5 n.png\nbump gone.png\n");
  EXPECT_EQ(scene.materials[0].normalScale, 0.5f);
  EXPECT_EQ(imageOf(scene, scene.materials[0].normalMap).texels, (Texels{128, 128, 255}));
  EXPECT_FALSE(imageOf(scene, scene.materials[0].normalMap).srgb);
}

// Slopes: half the difference of the neighbours, times -bm; n ~ (-slope right, -slope up, 1), coded
// as 127.5 (n + 1). Here rows are equal and a row is 0, 0, 1, 1, repeated: slopes to the right
// (0 - 1)/2, (1 - 0)/2, (1 - 0)/2, (0 - 1)/2. (1, 0, 2)/sqrt 5: 184.5, 127.5, 241.5.
TEST_F(ObjTextures, HeightsBecomeNormals) {
  picture("h.png", 4, 1, 1, {0, 0, 255, 255});
  const auto normals = [&](const std::string& line) {
    const Scene scene = square("Kd 1 1 1\n" + line);
    EXPECT_FALSE(imageOf(scene, scene.materials[0].normalMap).srgb);
    return imageOf(scene, scene.materials[0].normalMap).texels;
  };
  for (const char* key : {"bump", "map_bump", "map_Bump", "MAP_BUMP"})
    EXPECT_EQ(normals(std::string(key) + " h.png\n"),
              (Texels{185, 128, 242, 70, 128, 242, 70, 128, 242, 185, 128, 242}));
  EXPECT_EQ(normals("bump -bm 0 h.png\n")[0], 128);
  EXPECT_EQ(normals("bump -bm -1 h.png\n")[0], 70);
  EXPECT_EQ(normals("bump -mm 0 0 h.png\n")[0], 128);
  EXPECT_EQ(normals("bump -clamp on h.png\n")[0], 128) << "0 and its left neighbour are equal";
}

// Brighter above: the surface rises upwards, its normal leans down.
TEST_F(ObjTextures, HeightsRiseUpwards) {
  picture("h.png", 2, 3, 1, {255, 255, 128, 128, 0, 0});
  const Scene scene = square("bump -clamp on h.png\n");
  const uint8_t* middle = &imageOf(scene, scene.materials[0].normalMap).texels[6];
  EXPECT_EQ(middle[0], 128);
  EXPECT_EQ(middle[1], 70);
}

// What Blender writes as map_Bump.
TEST_F(ObjTextures, BumpsMayBeNormalMaps) {
  picture("n.png", 2, 1, 3, {128, 128, 255, 185, 128, 242});
  const auto normals = [&](const std::string& line) {
    const Scene scene = square("Kd 1 1 1\n" + line);
    return imageOf(scene, scene.materials[0].normalMap).texels;
  };
  EXPECT_EQ(normals("map_Bump -bm 1.0 n.png\n"), (Texels{128, 128, 255, 185, 128, 242}));
  // 185 and 242 are 0.451 and 0.898; (0.2255, 0, 0.898) normalized has x 0.2436: 158.6.
  EXPECT_EQ(normals("map_Bump -bm 0.5 n.png\n")[3], 159);
}

TEST_F(ObjTextures, FacesWithoutCoordinatesAreNamed) {
  picture("t.png", 1, 1, 3, {9, 8, 7});
  folder.write("a.mtl", "newmtl m\nmap_Kd t.png\n");
  const std::string text = "mtllib a.mtl\n" + kSquare + "usemtl m\nf 1 2 3\nf 1/1 3/3 4/4\n";
  EXPECT_CONTAINS(logOfFile(text), "1 faces have a texture but no texture coordinates");
  const Scene scene = read("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1 2 3\n");
  for (const Vec2 uv : scene.meshes[0].uv0) EXPECT_EQ(uv, Vec2(0, 1)) << "(0, 0) of the file";
  EXPECT_EQ(scene.meshes[0].uv0.size(), 3u);
}

}  // namespace
}  // namespace ninefold
