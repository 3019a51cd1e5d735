#include <gtest/gtest.h>

#include "common/scene/emitters.h"
#include "common/scene/needs.h"
#include "common/scene/reader.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/png_bytes.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

class ObjReader : public testing::Test {
 protected:
  // The square with one material whose lines these are.
  Material material(const std::string& lines) {
    folder.write("a.mtl", "newmtl m\n" + lines);
    return read("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1/1 2/2 3/3 4/4\n").materials.at(0);
  }
  Scene read(const std::string& text) { return readScene(folder.write("scene.obj", text)); }
  std::string error(const std::string& text) {
    const std::string what = errorOf([&] { read(text); });
    const std::string file = (folder.path() / "scene.obj").string() + ": ";
    EXPECT_EQ(what.find(file), 0u) << what;
    return what.substr(std::min(what.size(), file.size()));
  }
  TempFolder folder;
};

TEST_F(ObjReader, PolygonsBecomeTrianglesWithTheirWinding) {
  const Scene scene = read(kSquare + "f 1 2 3 4\n");
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_TRUE(mesh.uv0.empty());
  EXPECT_TRUE(mesh.normals.empty());
  for (const Triangle& t : mesh.triangles)
    EXPECT_GT(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                         mesh.positions[t.z] - mesh.positions[t.x])
                  .z,
              0);
}

TEST_F(ObjReader, NegativeIndicesCountFromTheEnd) {
  const Scene scene = read("v 9 9 9\n" + kSquare + "f -4/-4 -3/-3 -2/-2\n");
  EXPECT_EQ(scene.meshes[0].positions[1] - scene.meshes[0].positions[0], Vec3(1, 0, 0));
  EXPECT_EQ(scene.meshes[0].uv0[2], Vec2(1, 0));  // v points down here
}

TEST_F(ObjReader, GroupsAreSplitByMaterialAndStayOneThing) {
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
  const Scene scene = read("mtllib a.mtl\n" + kSquare +
                           "g table top\nusemtl red\nf 1 2 3\nusemtl green\nf 1 3 4\no chair\nf 1 "
                           "2 4\nusemtl red\nf 2 3 4\n");
  ASSERT_EQ(scene.instances.size(), 4u);
  EXPECT_EQ(scene.instances[0].node, scene.instances[1].node);
  EXPECT_EQ(scene.instances[2].node, scene.instances[3].node);
  EXPECT_NE(scene.instances[1].node, scene.instances[2].node);
  EXPECT_EQ(scene.instances[0].name, "table top");
  EXPECT_EQ(scene.instances[3].name, "chair");
  EXPECT_EQ(scene.materials.size(), 2u);
}

TEST_F(ObjReader, AbsentNormalsBecomeTheFaces) {
  const Scene scene = read(kSquare + "vn 0 0 5\nf 1//1 2//1 3\n");
  for (const Vec3& n : scene.meshes[0].normals) EXPECT_EQ(n, Vec3(0, 0, 1));
}

TEST_F(ObjReader, WindowsLinesAndCommentsAreUnderstood) {
  EXPECT_EQ(read("# a comment\r\nv 0 0 0 # here too\r\nv 1 0 0\r\nv 0 1 0\r\n\r\nf 1 2 3 \r\n")
                .meshes[0]
                .triangles.size(),
            1u);
}

TEST_F(ObjReader, PlainMaterials) {
  const Material matte = material("Kd 0.1 0.2 0.3\nKs 0 0 0\nNs 10\nillum 2\nKe 1 2 3\n");
  EXPECT_EQ(matte.baseColor, Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(matte.emission, Vec3(1, 2, 3));
  EXPECT_EQ(matte.metallic, 0);
  EXPECT_EQ(matte.specular, 0);
  EXPECT_TRUE(foldsIntoDiffuse(Scene{}, matte));
  const Material glossy = material("Kd 0.1 0.2 0.3\nKs 0.5 0.5 0.5\nNs 1998\n");
  EXPECT_EQ(glossy.specular, 1);
  EXPECT_EQ(glossy.specularColor, Vec3(1));
  EXPECT_NEAR(glossy.roughness * glossy.roughness, std::sqrt(2 / 2000.0f), 1e-6f);
}

TEST_F(ObjReader, MirrorsAndGlass) {
  const Material mirror = material("Kd 0.01 0.01 0.01\nKs 0.95 0.9 0.85\nNs 1000\nillum 5\n");
  EXPECT_EQ(mirror.metallic, 1);
  EXPECT_EQ(mirror.roughness, 0);
  EXPECT_EQ(mirror.baseColor, Vec3(0.95f, 0.9f, 0.85f));
  const Material glass = material("Kd 0 0 0\nKs 0.3 0.3 0.3\nTf 0.1 0.1 0.1\nNi 1.33\nillum 7\n");
  EXPECT_EQ(glass.transmission, 1);
  EXPECT_TRUE(glass.solid);
  EXPECT_EQ(glass.ior, 1.33f);
  EXPECT_EQ(glass.baseColor, Vec3(1)) << "a grey filter says nothing";
  EXPECT_EQ(material("Tf 0 0.2 0.1\nillum 6\n").baseColor, Vec3(0, 1, 0.5f));
}

TEST_F(ObjReader, DissolveBlends) {
  const Material m = material("Kd 1 1 1\nd 0.25\n");
  EXPECT_EQ(m.alphaMode, AlphaMode::blend);
  EXPECT_EQ(m.opacity, 0.25f);
  EXPECT_EQ(m.transmission, 0);
}

TEST_F(ObjReader, NumbersOutsideTheirRangeAreClamped) {
  const Material m = material("Kd 3 -1 nan\nKe -2 0 0\nNs -5\nd 7\n");
  EXPECT_EQ(m.baseColor, Vec3(1, 0, 0));
  EXPECT_EQ(m.emission, Vec3(0));
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
}

TEST_F(ObjReader, MapsAreFoundBesideTheFile) {
  folder.write("maps/wood grain.png", png(1, 1, 3, {9, 8, 7}));
  folder.write("bump.png", png(1, 1, 3, {128, 128, 255}));
  folder.write(
      "a.mtl",
      "newmtl m\nKd 0 0 0\nmap_Kd -s 2 3 1 -o 0.5 0.25 0 maps\\wood grain.png\n"
      "map_Ke -clamp on maps/wood grain.png\nnorm bump.png\nmap_bump missing_is_ignored.png\n");
  const Scene scene = read("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1/1 2/2 3/3\n");
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.baseColor, Vec3(1));
  EXPECT_EQ(m.baseColorMap.scale, Vec2(2, 3));
  EXPECT_EQ(m.baseColorMap.offset, Vec2(0.5f, 1 - 3 - 0.25f));
  EXPECT_EQ(m.emission, Vec3(1));
  EXPECT_EQ(m.emissionMap.wrapS, Wrap::clamp);
  EXPECT_EQ(m.emissionMap.image, m.baseColorMap.image);
  EXPECT_FALSE(scene.images[static_cast<size_t>(m.normalMap.image)].srgb);
}

TEST_F(ObjReader, OpacityMapsCutHolesIntoTheColour) {
  folder.write("leaf.png", png(2, 1, 3, {1, 2, 3, 4, 5, 6}));
  folder.write("cut.png", png(4, 1, 1, {255, 255, 0, 0}));
  folder.write("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd leaf.png\nmap_d cut.png\n");
  const Scene scene = read("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1/1 2/2 3/3\n");
  EXPECT_EQ(scene.materials[0].alphaMode, AlphaMode::mask);
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0].texels, (std::vector<uint8_t>{1, 2, 3, 255, 4, 5, 6, 0}));
}

TEST_F(ObjReader, MissingLibrariesGiveGreyAndOneWarningEach) {
  testing::internal::CaptureStderr();
  const Scene scene =
      read("mtllib gone.mtl\n" + kSquare + "usemtl red\nf 1 2 3\nusemtl red\nf 1 3 4\n");
  const std::string lines = testing::internal::GetCapturedStderr();
  EXPECT_CONTAINS(lines, "material library 'gone.mtl' is missing");
  EXPECT_CONTAINS(lines, "material 'red' is in no library: it is grey");
  EXPECT_EQ(scene.materials.size(), 1u);
}

TEST_F(ObjReader, BadNumbersAreErrorsWithTheirLine) {
  EXPECT_EQ(error("v 0 0 0\nv nan 0 0\n"),
            "line 2: 'nan' of a position is not a finite number: export the scene again");
  EXPECT_EQ(error("v 0 0 1e99\n"),
            "line 1: '1e99' of a position is not a finite number: export the scene again");
  EXPECT_EQ(error("v 1e-60 0 -1e-999\n"), "no geometry: the scene has no triangle to show");
  EXPECT_EQ(error("v 0 0\n"), "line 1: a position needs 3 numbers, it has 2");
  EXPECT_EQ(error("\r\n\r\nvn 0 zero 1\n"),
            "line 3: 'zero' of a normal is not a finite number: export the scene again");
}

TEST_F(ObjReader, BadIndicesAreErrorsWithTheirLine) {
  EXPECT_EQ(error(kSquare + "f 1 2 5\n"),
            "line 9: position index 5 is out of range, 4 are defined before it");
  EXPECT_EQ(error(kSquare + "f 1 2 0\n"),
            "line 9: position index 0 is out of range, 4 are defined before it");
  EXPECT_EQ(error(kSquare + "f 1 2 -5\n"),
            "line 9: position index -5 is out of range, 4 are defined before it");
  EXPECT_EQ(error(kSquare + "f 1/9 2 3\n"),
            "line 9: texture coordinate index 9 is out of range, 4 are defined before it");
  EXPECT_EQ(error(kSquare + "f 1//1 2 3\n"),
            "line 9: normal index 1 is out of range, 0 are defined before it");
  EXPECT_EQ(error(kSquare + "f 1 2 99999999999\n"),
            "line 9: position index 99999999999 is out of range, 4 are defined before it");
  EXPECT_EQ(error(kSquare + "f a b c\n"), "line 9: 'a' is no index of a position");
  EXPECT_EQ(error(kSquare + "f 1 2\n"),
            "line 9: a face of 2 corners, 3 to 1024 are supported: triangulate it");
}

TEST_F(ObjReader, NoGeometry) {
  EXPECT_EQ(error(""), "no geometry: the scene has no triangle to show");
  EXPECT_EQ(error(kSquare), "no geometry: the scene has no triangle to show");
  EXPECT_EQ(error(kSquare + "f 1 1 2\n"), "no geometry: the scene has no triangle to show");
}

TEST_F(ObjReader, BinaryFilesAreRefused) {
  EXPECT_EQ(error(std::string("v 0 0 0\0v", 9)), "not an OBJ file: it has zero bytes");
}

TEST_F(ObjReader, MissingAndOutsideTexturesAreErrors) {
  const std::string where = std::filesystem::canonical(folder.path()).string();
  const auto errorWith = [&](const std::string& map) {
    folder.write("a.mtl", "newmtl m\nmap_Kd " + map + "\n");
    return error("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1 2 3\n");
  };
  EXPECT_EQ(
      errorWith("gone.png"),
      "material 'm': texture 'gone.png': 'gone.png' is missing: put it into the scene's folder " +
          where);
  EXPECT_EQ(errorWith("..\\up.png"),
            "material 'm': texture '../up.png': '../up.png' leads outside the scene's folder: copy "
            "the file there");
  EXPECT_CONTAINS(errorWith("/etc/passwd"), "is not a path beneath the scene's folder");
  EXPECT_CONTAINS(errorWith("C:\\textures\\wood.png"), "is not a path beneath the scene's folder");
  EXPECT_CONTAINS(error("mtllib ../a.mtl\n" + kSquare + "f 1 2 3\n"),
                  "leads outside the scene's folder");
}

}  // namespace
}  // namespace ninefold
