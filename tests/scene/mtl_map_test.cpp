// Options and names of maps. Coordinates: u' = s u + o; v grows upwards in the file and downwards
// in the scene, so its offset is 1 - s - o there.
#include "tests/scene/obj_folder.h"

namespace ninefold {
namespace {

class MtlMaps : public ObjFolder {
 protected:
  MtlMaps() {
    for (const char* name : {"t.png", "t a.png", "2 t.png", "3.png", "tex/t.png"})
      picture(name, 1, 1, 3, {9, 8, 7});
  }
  TextureUse use(const std::string& rest) {
    return material("Kd 1 1 1\nmap_Kd " + rest + "\n").baseColorMap;
  }
  std::string nameOf(const std::string& rest) {
    const Scene scene = square("Kd 1 1 1\nmap_Kd " + rest + "\n");
    return imageOf(scene, scene.materials[0].baseColorMap).name;
  }
};

TEST_F(MtlMaps, TakesOneTwoOrThreeNumbers) {
  for (const char* rest : {"-s 2 2 t.png", "-s 2 2 1 t.png", "-s 2 2 1.0 \t t.png \r"}) {
    EXPECT_EQ(use(rest).scale, Vec2(2, 2)) << rest;
    EXPECT_EQ(use(rest).offset, Vec2(0, -1)) << rest;
  }
  EXPECT_EQ(use("-s 2 t.png").scale, Vec2(2, 1));
  EXPECT_EQ(use("-o 0.5 t.png").offset, Vec2(0.5f, 0));
  EXPECT_EQ(use("-o 0.5 -0.25 t.png").offset, Vec2(0.5f, 0.25f));
  EXPECT_EQ(use("-o 0.5 0.25 7 t.png").offset, Vec2(0.5f, -0.25f));
  EXPECT_EQ(use("-t 0 0 t.png").scale, Vec2(1));
  const TextureUse all = use("-S 2 -3 1 -O 0.25 0.125 t.png");
  EXPECT_EQ(all.scale, Vec2(2, -3));
  EXPECT_EQ(all.offset, Vec2(0.25f, 1 + 3 - 0.125f));
}

TEST_F(MtlMaps, SkipsWhatSaysNothingToUs) {
  for (const char* rest :
       {"-blendu on -blendv off -cc off -clamp off -texres 256 -boost 1.5 -type sphere t.png",
        "-bm t.png", "-bm 0.5 t.png", "-texres 256x256 t.png", "-clamp t.png"}) {
    EXPECT_EQ(nameOf(rest), "texture 't.png'") << rest;
    EXPECT_EQ(use(rest).wrapS, Wrap::repeat) << rest;
  }
  EXPECT_EQ(use("-clamp on t.png").wrapT, Wrap::clamp);
  EXPECT_CONTAINS(logOf("map_Kd -t 0.1 0.2 0 -cc on t.png\n"), "-cc (line 2), -t (line 2)");
}

TEST_F(MtlMaps, OptionsMayStandBehindTheName) {
  EXPECT_EQ(use("t.png -s 2 3 1").scale, Vec2(2, 3));
  EXPECT_EQ(use("t.png\t-s 2 3 # tiles").scale, Vec2(2, 3));
  EXPECT_EQ(use("-o 1 1 t a.png -s 2 3 -clamp on").scale, Vec2(2, 3));
  EXPECT_EQ(use("-o 0.5 1 t a.png -s 2 3 -clamp on").offset, Vec2(0.5f, 1 - 3 - 1));
}

TEST_F(MtlMaps, NamesAreWhatIsAFile) {
  EXPECT_EQ(nameOf("t a.png"), "texture 't a.png'");
  EXPECT_EQ(nameOf("\"t a.png\"  "), "texture 't a.png'");
  EXPECT_EQ(nameOf(".\\t.png"), "texture './t.png'");
  EXPECT_EQ(nameOf("tex\\t.png"), "texture 'tex/t.png'");
  EXPECT_EQ(nameOf("-s 2 2 3.png"), "texture '3.png'");
  EXPECT_EQ(nameOf("-s 2 2 2 t.png"), "texture 't.png'");
  EXPECT_EQ(use("-s 4 4 2 t.png").scale, Vec2(4, 4));
  EXPECT_EQ(nameOf("t.png # of the floor"), "texture 't.png'");
  picture("7", 1, 1, 3, {9, 8, 7});
  EXPECT_EQ(nameOf("-s 2 2 7"), "texture '7'");
  EXPECT_EQ(use("-s 2 3 7").scale, Vec2(2, 3));
  std::filesystem::remove(folder.path() / "t.png");
  EXPECT_EQ(nameOf("-s 4 4 2 t.png"), "texture '2 t.png'");
  EXPECT_EQ(use("-s 4 5 2 t.png").scale, Vec2(4, 5));
}

TEST_F(MtlMaps, PathsOfOtherMachinesMeanTheFileBesideTheLibrary) {
  for (const char* rest :
       {"C:\\x\\y\\t.png", "/home/them/t.png", "..\\..\\t.png", "\\\\host\\t.png", "missing/t.png"})
    EXPECT_EQ(nameOf(rest), "texture 't.png'") << rest;
}

TEST_F(MtlMaps, TheCaseOfANameIsTheLastThingThatMatters) {
  EXPECT_EQ(nameOf("T.PNG"), "texture 't.png'");
  EXPECT_EQ(nameOf("Tex\\T.png"), "texture 't.png'") << "the folder's case is its own";
  picture("T.PNG", 1, 1, 3, {1, 1, 1});
  EXPECT_EQ(nameOf("T.PNG"), "texture 'T.PNG'");
}

TEST_F(MtlMaps, FilesAreBesideTheLibraryThatNamesThem) {
  picture("lib/image.png", 1, 1, 3, {1, 2, 3});
  picture("lib/t.png", 1, 1, 3, {4, 5, 6});
  const auto texel = [&](const std::string& map) {
    folder.write("lib/m.mtl", "newmtl m\nKd 1 1 1\nmap_Kd " + map + "\n");
    const Scene scene = read("mtllib lib\\m.mtl\n" + kSquare + "usemtl m\nf 1/1 2/2 3/3\n");
    return scene.images[0].texels[0];
  };
  EXPECT_EQ(texel("image.png"), 1);
  EXPECT_EQ(texel("t.png"), 4) << "beside the library before beside the scene";
  EXPECT_EQ(texel("../t.png"), 9) << "within the scene's folder .. is allowed";
  EXPECT_EQ(texel("t a.png"), 9);
}

TEST_F(MtlMaps, LibrariesMayBeSeveralAndHaveBlanks) {
  folder.write("file with space.mtl", "newmtl red\nKd 1 0 0\n");
  folder.write("green.mtl", "newmtl green\nKd 0 1 0\n");
  for (const char* line :
       {"mtllib file with space.mtl green.mtl\n", "mtllib \"file with space.mtl\" green.mtl\n",
        "mtllib green.mtl  file with space.mtl \r\n",
        "mtllib green.mtl gone.mtl file with space.mtl\n",
        "mtllib \"file with space.mtl\"\nmtllib green.mtl # both\n",
        "mtllib C:\\work\\file with space.mtl\nmtllib /home/them/green.mtl\n"}) {
    const Scene scene = read(line + kSquare + "usemtl red\nf 1 2 3\nusemtl green\nf 1 3 4\n");
    EXPECT_EQ(scene.materials.at(0).baseColor, Vec3(0, 1, 0)) << line;
    EXPECT_EQ(scene.materials.at(1).baseColor, Vec3(1, 0, 0)) << line;
  }
}

TEST_F(MtlMaps, MissingLibrariesGiveGreyAndOneWarningEach) {
  const std::string lines =
      logOfFile("mtllib gone.mtl\n" + kSquare + "usemtl red\nf 1 2 3\nusemtl red\nf 1 3 4\n");
  EXPECT_CONTAINS(lines, "material library 'gone.mtl' is missing");
  EXPECT_CONTAINS(lines, "material 'red' is in no library: it is grey");
  EXPECT_CONTAINS(logOfFile("mtllib ../gone.mtl\n" + kSquare + "f 1 2 3\n"),
                  "material library '../gone.mtl' is missing");
}

TEST_F(MtlMaps, MissingTexturesAreErrors) {
  const std::string where = std::filesystem::canonical(folder.path()).string();
  EXPECT_EQ(
      errorOfMaterial("map_Kd gone.png\n"),
      "material 'm': texture 'gone.png': 'gone.png' is missing: put it into the scene's folder " +
          where);
  EXPECT_EQ(errorOfMaterial("map_Kd ..\\up.png\n"),
            "material 'm': texture '../up.png': '../up.png' leads outside the scene's folder: copy "
            "the file there");
  EXPECT_CONTAINS(errorOfMaterial("map_Kd /etc/passwd\n"),
                  "is not a path beneath the scene's folder");
  EXPECT_CONTAINS(errorOfMaterial("map_d C:\\textures\\wood.png\n"),
                  "is not a path beneath the scene's folder");
  EXPECT_CONTAINS(errorOfMaterial("map_Ke -s 2 2 gone.png\n"), "texture 'gone.png'");
}

}  // namespace
}  // namespace ninefold
