#include <gtest/gtest.h>

#include "tests/scene/obj_folder.h"

namespace ninefold {
namespace {

using ObjReader = ObjFolder;

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
  EXPECT_EQ(error(std::string("v 0 0 0\0v", 9)),
            "not a text file: it has zero bytes; if it is UTF-16, save it as UTF-8");
}

TEST_F(ObjReader, Utf16IsRefusedInOneLine) {
  EXPECT_EQ(error(std::string("\xFF\xFEv\0 \0", 6)), "the file is UTF-16 text: save it as UTF-8");
  EXPECT_EQ(error(std::string("\xFE\xFF\0v\0 ", 6)), "the file is UTF-16 text: save it as UTF-8");
}

// The square's plane is z = 0; were the mark part of the first word, its first corner, its library
// or its comment would be lost.
TEST_F(ObjReader, AByteOrderMarkIsSkippedBeforeAnyFirstWord) {
  const std::string mark = "\xEF\xBB\xBF";
  folder.write("a.mtl", mark + "newmtl red\nKd 1 0 0\n");
  const std::string face = "usemtl red\nf 1/1 2/2 3/3 4/4\n";
  for (const std::string& text :
       {mark + kSquare + "mtllib a.mtl\n" + face, mark + "mtllib a.mtl\n" + kSquare + face,
        mark + "# made by hand\nmtllib a.mtl\n" + kSquare + face,
        mark + "\r\nmtllib a.mtl\r\n" + kSquare + face,
        mark + "\\\nmtllib a.mtl\n" + kSquare + face,
        "mtllib a.mtl\n" + mark + kSquare + mark + face}) {
    const Scene scene = read(text);
    EXPECT_EQ(scene.materials.at(0).baseColor, Vec3(1, 0, 0)) << text;
    EXPECT_EQ(scene.meshes[0].positions.size(), 4u) << text;
  }
}

TEST_F(ObjReader, ABackslashContinuesALine) {
  const Scene scene = read("v 0 0 \\\n0\nv 1 0 0\nv 1\\\r\n 1 0\nf 1 \\\n2 \\\n3\n");
  EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
  EXPECT_EQ(error("v 0 \\\n0 0\nv 1 x 0\n").substr(0, 7), "line 3:");
  EXPECT_EQ(error("# C:\\models\\\nv 1 x 0\n").substr(0, 7), "line 2:") << "no comment continues";
  EXPECT_EQ(error("v 0 0 0 \\"), "no geometry: the scene has no triangle to show");
}

TEST_F(ObjReader, LibrariesMayStandBehindTheFaces) {
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\n");
  EXPECT_EQ(read(kSquare + "usemtl red\nf 1 2 3\nmtllib a.mtl\n").materials[0].baseColor,
            Vec3(1, 0, 0));
}

TEST_F(ObjReader, NamesMayHaveBlanksTabsAndQuotes) {
  folder.write("a.mtl", "newmtl  Hard  Shiny\tWhite \r\nKd 1 0 0\nnewmtl \"b c\"\nKd 0 1 0\n");
  const Scene scene =
      read("mtllib a.mtl\n" + kSquare + "o  a  thing \nusemtl Hard Shiny White\nf 1 2 3\n" +
           "g \"my group\"\nusemtl b c\nf 1 3 4\n");
  EXPECT_EQ(scene.materials[0].baseColor, Vec3(1, 0, 0));
  EXPECT_EQ(scene.materials[1].baseColor, Vec3(0, 1, 0));
  EXPECT_EQ(scene.instances[0].name, "a thing");
  EXPECT_EQ(scene.instances[1].name, "my group");
}

TEST_F(ObjReader, CommentsBehindNamesAreNoPartOfThem) {
  folder.write("a.mtl", "newmtl red # the wall\nKd 1 0 0\nnewmtl Material #25\nKd 0 1 0\n");
  const Scene scene = read("mtllib a.mtl # mine\n" + kSquare +
                           "usemtl red\nf 1 2 3\nusemtl Material #25 # 3ds\nf 1 3 4\n");
  EXPECT_EQ(scene.materials[0].baseColor, Vec3(0, 1, 0));  // parts are in the order of their names
  EXPECT_EQ(scene.materials[1].baseColor, Vec3(1, 0, 0));
}

TEST_F(ObjReader, WhatNobodyReadsIsNamedInOneWarning) {
  EXPECT_CONTAINS(logOfFile(kSquare + "s 1\nf 1 2 3\nl 1 2\nl 2 3\nv 0 0 0 0.5\nvp 1\n"),
                  "the OBJ file: not modelled and left out: l (line 11), s without normals (line "
                  "10), vp (line 14), weight of v (line 13)");
  const std::string nothing = logOfFile("# x\n" + kSquare + "s off\ng\nf 1 2 3 # y\n");
  EXPECT_EQ(nothing.find("left out"), std::string::npos) << nothing;
}

}  // namespace
}  // namespace ninefold
