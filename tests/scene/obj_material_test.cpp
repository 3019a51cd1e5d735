// The table at the head of mtl_translation.h. Expected numbers are that table's formulas.
#include "common/scene/needs.h"
#include "tests/scene/obj_folder.h"

namespace ninefold {
namespace {

using ObjMaterial = ObjFolder;

// F0 of a metal or of a dielectric.
Vec3 normalReflectance(const Material& m) {
  if (m.metallic == 1) return m.baseColor;
  const float r = (m.ior - 1) / (m.ior + 1);
  return r * r * m.specular * m.specularColor;
}

void expectOrdinary(const Material& m, Vec3 Kd) {
  EXPECT_EQ(m.baseColor, Kd);
  EXPECT_EQ(m.metallic, 0);
  EXPECT_EQ(m.transmission, 0);
}

TEST_F(ObjMaterial, Plain) {
  const Material matte = material("Kd 0.1 0.2 0.3\nKs 0 0 0\nNs 10\nillum 2\nKe 1 2 3\n");
  expectOrdinary(matte, Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(matte.emission, Vec3(1, 2, 3));
  EXPECT_EQ(matte.specular, 0);
  EXPECT_TRUE(foldsIntoDiffuse(Scene{}, matte));
  const Material glossy = material("Kd 0.1 0.2 0.3\nKs 0.5 0.5 0.5\nNs 1998\n");
  EXPECT_EQ(glossy.specular, 1);
  EXPECT_EQ(glossy.specularColor, Vec3(1));
  EXPECT_NEAR(glossy.roughness * glossy.roughness, std::sqrt(2 / 2000.0f), 1e-6f);
}

TEST_F(ObjMaterial, KeysCountInAnyCaseAndColoursMayBeOneNumber) {
  expectOrdinary(material("kd 0.25\nKS 0\nILLUM 2\n"), Vec3(0.25f));
}

TEST_F(ObjMaterial, ThatSaysNothingIsGrey) {
  expectOrdinary(material("Ns 10\n"), Vec3(0.6f));
  expectOrdinary(material("Ke 1 1 1\n"), Vec3(0));
}

TEST_F(ObjMaterial, NumbersOutsideTheirRangeAreClamped) {
  const Material m = material("Kd 3 -1 0\nKe -2 0 0\nNs -5\nd 7\n");
  EXPECT_EQ(m.baseColor, Vec3(1, 0, 0));
  EXPECT_EQ(m.emission, Vec3(0));
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
}

// Where d is 1 or nothing says that light passes, every illumination model shows Kd.
TEST_F(ObjMaterial, IsOpaqueUnderEveryIllumination) {
  for (int illum = 0; illum <= 12; ++illum)
    for (const char* lines : {"d 1\n", "Tr 0\n", "d 1\nTf 1 1 1\n", "d 1\nTf 0.2 0.9 0.2\nNi 1.5\n",
                              "", "Tf 0 0 0\n", "Ni 1.5\n"}) {
      const Material m =
          material("Kd 0.8 0.2 0.1\nKs 0.5 0.5 0.5\nillum " + std::to_string(illum) + "\n" + lines);
      EXPECT_EQ(m.transmission, 0) << illum << lines;
      EXPECT_EQ(m.alphaMode, AlphaMode::opaque) << illum << lines;
      EXPECT_EQ(m.baseColor, Vec3(0.8f, 0.2f, 0.1f)) << illum << lines;
      const bool metal = illum == 3 || illum == 5 || illum == 8;
      EXPECT_EQ(m.metallic, metal ? 1 : 0) << illum << lines;
    }
}

// Maya writes every opaque surface so.
TEST_F(ObjMaterial, Illum4WithAFilterIsOpaque) {
  expectOrdinary(material("illum 4\nKd 0.4 0.4 0.4\nKa 0 0 0\nTf 1 1 1\nNi 1\n"), Vec3(0.4f));
  expectOrdinary(material("illum 4\nKd 0 0 0\nKa 0 0 0\nTf 1 1 1\nNi 1\n"), Vec3(0));
}

// Blender and MeshLab: opacity, whatever the model. Blender writes 9 for it, 6 for a metal.
TEST_F(ObjMaterial, DissolveBlendsUnderEveryIllumination) {
  for (int illum = 0; illum <= 12; ++illum)
    for (const char* lines : {"d 0.25\n", "Tr 0.75\n", "d -halo 0.25\n", "d 0.25\nTf 0 0 0\n"}) {
      const Material m = material("Kd 0.8 0.2 0.1\nKs 0.5 0.5 0.5\nNi 1.5\nillum " +
                                  std::to_string(illum) + "\n" + lines);
      EXPECT_EQ(m.alphaMode, AlphaMode::blend) << illum << lines;
      EXPECT_EQ(m.opacity, 0.25f) << illum << lines;
      EXPECT_EQ(m.transmission, 0) << illum << lines;
      EXPECT_EQ(m.baseColor, Vec3(0.8f, 0.2f, 0.1f)) << illum << lines;
      const bool metal = illum == 3 || illum == 5 || illum == 6 || illum == 8;
      EXPECT_EQ(m.metallic, metal ? 1 : 0) << illum << lines;
    }
}

TEST_F(ObjMaterial, DWinsOverTrAndSaysSo) {
  EXPECT_EQ(material("Kd 1 1 1\nd 0.25\nTr 0.25\n").opacity, 0.25f);
  EXPECT_CONTAINS(logOf("Kd 1 1 1\nd 0.25\nTr 0.25\n"),
                  "left out: Tr where d is not 1 - Tr (line 4)");
  const std::string agree = logOf("Kd 1 1 1\nd 0.25\nTr 0.75\n");
  EXPECT_EQ(agree.find("left out"), std::string::npos) << agree;
}

TEST_F(ObjMaterial, Tr1AloneIsMeshLabsOpaque) {
  EXPECT_EQ(material("Kd 1 1 1\nTr 1.000000\nillum 2\n").opacity, 1);
  EXPECT_CONTAINS(logOf("Kd 1 1 1\nTr 1.000000\n"),
                  "left out: Tr 1 without d, which nobody would see (line 3)");
  EXPECT_EQ(material("Kd 1 1 1\nd 0\n").opacity, 0);
}

TEST_F(ObjMaterial, GlassIsToldByItsFilter) {
  for (const char* lines :
       {"Kd 0 0 0\nKs 0.3 0.3 0.3\nTf 0.1 0.1 0.1\nNi 1.33\nillum 7\n",
        "Kd 0.01 0.01 0.01\nNi 1.33\nillum 7\n", "Kd 0 0 0\nTf 1 1 1\nd 1\nNi 1.33\nillum 6\n",
        "Kd 0 0 0\nTf 1 1 1\nd 0.1\nNi 1.33\nillum 4\n", "Kd 0 0 0\nd 0\nNi 1.33\nillum 9\n"}) {
    const Material glass = material(lines);
    EXPECT_EQ(glass.transmission, 1) << lines;
    EXPECT_TRUE(glass.solid) << lines;
    EXPECT_EQ(glass.ior, 1.33f) << lines;
    EXPECT_EQ(glass.roughness, 0) << lines;
    EXPECT_EQ(glass.alphaMode, AlphaMode::opaque) << lines;
    EXPECT_EQ(glass.baseColor, Vec3(1)) << lines << "a grey filter says nothing";
  }
  EXPECT_EQ(material("Tf 0 0.2 0.1\nillum 6\n").baseColor, Vec3(0, 1, 0.5f));
  EXPECT_EQ(material("Kd 0 0 1\nTf 1 1 1\nNi 1.2\nillum 7\n").baseColor, Vec3(0, 0, 1));
}

TEST_F(ObjMaterial, MirrorsReflectKsOverKd) {
  for (const char* illum : {"illum 3\n", "illum 5\n", "illum 8\n"}) {
    const Material m = material(std::string("Kd 0.1 0.05 0\nKs 0.95 0.9 0.85\nNs 1000\n") + illum);
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.roughness, 0);
    EXPECT_EQ(m.baseColor, Vec3(0.1f, 0.05f, 0));
    const Vec3 F0 = normalReflectance(m);
    EXPECT_NEAR(F0.x, 0.95f, 1e-4f);
    EXPECT_NEAR(F0.y, 0.9f, 1e-4f);
    EXPECT_NEAR(F0.z, 0.85f, 1e-4f);
  }
  EXPECT_EQ(material("Kd 0 0 0\nKs 0.4 0.4 0.4\nillum 3\n").roughness, 0);
  EXPECT_EQ(normalReflectance(material("Kd 0.01 0.01 0.01\nKs 1 1 1\nKa 0 0 0\nillum 5\n")),
            Vec3(1));
  EXPECT_NEAR(normalReflectance(material("Kd 0 0 0\nKs 0.4 0.4 0.4\nillum 3\n")).x, 0.4f, 1e-4f);
  EXPECT_NEAR(material("Kd 0 0 0\nKs 1 1 1\nNs 250\nillum 3\n").roughness, 0.5f, 1e-6f);
}

// As Blender writes and reads it without its physically based keys: metallic is Ka, roughness is
// 1 - sqrt(Ns / 1000).
TEST_F(ObjMaterial, MetalsOfBlender) {
  const std::string lines = "Kd 0.3 0.15 0.05\nKs 0.5 0.5 0.5\nNi 1.5\nNs 250\nd 1\nillum 3\n";
  EXPECT_EQ(material(lines).metallic, 1);
  EXPECT_EQ(material(lines).baseColor, Vec3(0.3f, 0.15f, 0.05f));
  EXPECT_NEAR(material(lines).roughness, 0.5f, 1e-6f);
  EXPECT_NEAR(material(lines + "Ka 0.75 0.75 0.75\n").metallic, 0.75f, 1e-6f);
}

TEST_F(ObjMaterial, PhysicallyBasedKeys) {
  const Material metal =
      material("Kd 0.3 0.15 0.05\nKs 0.5 0.5 0.5\nNs 250\nillum 3\nPr 0.25\nPm 1\n");
  EXPECT_EQ(metal.metallic, 1);
  EXPECT_EQ(metal.roughness, 0.25f);
  EXPECT_EQ(metal.baseColor, Vec3(0.3f, 0.15f, 0.05f));
  const Material plastic = material("Kd 0.3 0.15 0.05\nPr 0.25\nillum 7\n");
  expectOrdinary(plastic, Vec3(0.3f, 0.15f, 0.05f));
  EXPECT_EQ(plastic.specular, 1);
  EXPECT_NEAR(normalReflectance(plastic).x, 0.04f, 1e-6f);
  EXPECT_EQ(material("Kd 1 1 1\nPr 0\nd 0.5\nillum 9\n").opacity, 0.5f);
}

// Blender's transmission, beside its usual d 1 and illum 2.
TEST_F(ObjMaterial, PhysicallyBasedGlass) {
  const Material m =
      material("Kd 0.9 0.8 0.7\nKs 0.5 0.5 0.5\nNi 1.45\nd 1\nillum 2\nPr 0.25\nPm 0\nTf 1 1 1\n");
  EXPECT_EQ(m.transmission, 1);
  EXPECT_TRUE(m.solid);
  EXPECT_EQ(m.baseColor, Vec3(0.9f, 0.8f, 0.7f));
  EXPECT_EQ(m.roughness, 0.25f);
  EXPECT_EQ(m.ior, 1.45f);
}

TEST_F(ObjMaterial, SheenAndCoatLieOverWhatIsOpaque) {
  for (const char* other : {"", "Pr 0.5\n", "illum 3\nKs 1 1 1\n"}) {
    const Material m =
        material(std::string("Kd 0.5 0.1 0.1\nPs 0.25\nPc 0.5\nPcr 0.125\n") + other);
    EXPECT_EQ(m.sheenColor, Vec3(0.25f)) << other;
    EXPECT_EQ(m.sheenRoughness, 0.5f) << other;
    EXPECT_EQ(m.coat, 0.5f) << other;
    EXPECT_EQ(m.coatRoughness, 0.125f) << other;
  }
  const Material none = material("Kd 1 1 1\nPs 0\nPc 0\nPcr 0.03\n");
  EXPECT_FALSE(hasCoat(none) || hasSheen(none));
  EXPECT_EQ(none.coatRoughness, 0);
  EXPECT_EQ(material("Kd 1 1 1\nPc 7\n").coat, 1);
  EXPECT_CONTAINS(logOf("Kd 1 1 1\nPr 0\nTf 1 1 1\nPc 1\n"),
                  "material 'm': coat and sheen are left out, as light passes through it");
}

TEST_F(ObjMaterial, WhatIsNotModelledIsNamedInOneWarning) {
  EXPECT_CONTAINS(
      logOf("Ka 1 1 1\nKd 1 1 1\nPr 0\nPc 0\naniso 0.1\nrefl x.png\ndisp y.png\nwrong 1\n"),
      "material library 'a.mtl': not modelled and left out: Ka (line 2), aniso (line 6), disp "
      "(line "
      "8), refl (line 7), wrong (line 9)\n");
  const std::string nothing =
      logOf("Ka 0 0 0\nKd 1 1 1\nPs 0 # x\nPc 0\nPcr 0.03\naniso 0\nanisor 0\n");
  EXPECT_EQ(nothing.find("left out"), std::string::npos) << nothing;
}

TEST_F(ObjMaterial, IlluminationsThatAreNoneAreNamed) {
  EXPECT_CONTAINS(logOf("Kd 1 1 1\nillum 10\n"), "illum beyond 0 to 9 (line 3)");
}

TEST_F(ObjMaterial, BadNumbersAreNamedWithFileAndLine) {
  EXPECT_CONTAINS(logOf("Kd 1 x 0\n"),
                  "material library 'a.mtl', line 2: 'x' of Kd is not a finite number: the line is "
                  "left out");
  EXPECT_CONTAINS(logOf("Kd 1 1 1\nNs nan\n"), "line 3: 'nan' of Ns is not a finite number");
  EXPECT_CONTAINS(logOf("Kd 1 1 1\nNs\n"), "line 3: Ns has no number");
  EXPECT_CONTAINS(logOf("Kd 1 1 1\nmap_Kd -s 2 2\n"), "line 3: map_Kd has no file name");
}

TEST_F(ObjMaterial, LibrariesThatAreNoText) {
  folder.write("a.mtl", std::string_view("\xFF\xFEn\0", 4));
  EXPECT_EQ(error("mtllib a.mtl\n" + kSquare + "f 1 2 3\n"),
            "material library 'a.mtl': the file is UTF-16 text: save it as UTF-8");
}

}  // namespace
}  // namespace ninefold
