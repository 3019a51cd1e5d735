// Bad glTF files: each ends in one line that says what, where and what to do; none in a crash, a
// hang or gigabytes of memory.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/png_bytes.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

std::string errorOfFile(const std::filesystem::path& file) {
  const std::string text = errorOf([&] { readScene(file); });
  EXPECT_EQ(text.find(file.string()), 0u) << "the message does not begin with the file: " << text;
  return text.substr(std::min(text.size(), file.string().size() + 2));
}

std::string errorOfGlb(const Bytes& file) {
  const TempFolder folder;
  return errorOfFile(folder.write("bad.glb", file));
}

std::string errorOfJson(const std::string& json) { return errorOfGlb(triangleGlb(json)); }

// The triangle as a .gltf whose buffer is the given file of `folder`.
std::string textWithBuffer(const std::string& uri) {
  return with(kTriangleJson, R"({"byteLength": 48})",
              R"({"byteLength": 48, "uri": ")" + uri + "\"}");
}

TEST(BadGltf, MissingFileIsNamed) {
  EXPECT_EQ(errorOf([] { readScene("/nowhere/scene.glb"); }),
            "/nowhere/scene.glb: '/nowhere/scene.glb' cannot be read (No such file or directory): "
            "check its name and its permissions");
}

TEST(BadGltf, UnknownFormatsAreRefused) {
  const TempFolder folder;
  EXPECT_EQ(errorOfFile(folder.write("scene.fbx", "x")),
            "not a scene that can be read: .gltf, .glb and .obj are known");
}

TEST(BadGltf, EveryTruncationEndsInOneLine) {
  const Bytes whole = triangleGlb();
  const TempFolder folder;
  for (size_t size = 0; size < whole.size(); size += size < 40 ? 1 : 17) {
    const auto file =
        folder.write("bad.glb", Bytes(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)));
    EXPECT_FALSE(errorOfFile(file).empty());
  }
}

TEST(BadGltf, TruncationSaysWhatIsMissing) {
  Bytes file = triangleGlb();
  file.resize(file.size() - 10);
  EXPECT_EQ(errorOfGlb(file), "truncated: the header tells of " + std::to_string(file.size() + 10) +
                                  " bytes, the file has " + std::to_string(file.size()));
  const TempFolder folder;
  EXPECT_EQ(errorOfFile(folder.write("bad.gltf", kTriangleJson.substr(0, 200))),
            "truncated: its JSON ends in the middle");
}

TEST(BadGltf, ChunkLongerThanTheFile) {
  Bytes file = triangleGlb();
  const size_t binaryHead = file.size() - 48 - 8;
  file[binaryHead] = 56;  // eight bytes more than there are
  EXPECT_EQ(errorOfGlb(file), "truncated: the BIN chunk has 56 bytes, only 48 are there");
}

TEST(BadGltf, OldVersion) {
  Bytes file = triangleGlb();
  file[4] = 1;
  EXPECT_EQ(errorOfGlb(file), "glTF version 1 is not supported: export as glTF 2.0");
}

TEST(BadGltf, IndexOutOfRange) {
  Bytes bytes = triangleBytes();
  bytes[36 + 8] = 3;
  EXPECT_EQ(errorOfGlb(glb(kTriangleJson, bytes)),
            "node 0 'thing': mesh 0 'shape' primitive 0: index 3 at place 2 is out of range, there "
            "are 3 vertices");
}

TEST(BadGltf, PositionThatIsNotANumber) {
  Bytes bytes = triangleBytes();
  bytes[14] = 0xC0, bytes[15] = 0x7F;  // second vertex, x
  EXPECT_EQ(errorOfGlb(glb(kTriangleJson, bytes)),
            "node 0 'thing': mesh 0 'shape' primitive 0: position 1 is not a finite number: export "
            "the scene again");
}

TEST(BadGltf, HugeCountsCostNoMemory) {
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("count": 3, "type": "VEC3")",
                                   R"("count": 4000000000, "type": "VEC3")")),
                  "4000000000 elements from byte 0 end beyond buffer view 0 of 36 bytes");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("count": 3, "type": "SCALAR")",
                                   R"("count": 4611686018427387904, "type": "SCALAR")")),
                  "elements from byte 0 end beyond buffer view 1 of 12 bytes");
  EXPECT_CONTAINS(
      errorOfJson(with(kTriangleJson, R"({"bufferView": 0, "componentType": 5126, "count": 3,)",
                       R"({"componentType": 5126, "count": 4000000000,)")),
      "claims 4000000000 elements but has no data");
  EXPECT_FALSE(
      errorOfJson(with(kTriangleJson, R"({"byteLength": 48})", R"({"byteLength": 4000000000})"))
          .empty());
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100 * 1024) << "kilobytes";
}

TEST(BadGltf, ViewsAndOffsetsBeyondTheirBuffers) {
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("byteOffset": 36, "byteLength": 12)",
                                   R"("byteOffset": 36, "byteLength": 13)")),
                  "buffer view 1 ends beyond its buffer of 48 bytes");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("byteOffset": 36, "byteLength": 12)",
                                   R"("byteOffset": 18446744073709551604, "byteLength": 60)")),
                  "buffer");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"({"bufferView": 1,)",
                                   R"({"bufferView": 1, "byteOffset": 4,)")),
                  "3 elements from byte 4 end beyond buffer view 1 of 12 bytes");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"({"bufferView": 1,)", R"({"bufferView": 7,)")),
                  "accessor[1] invalid bufferView");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("indices": 1)", R"("indices": 9)")),
                  "primitive indices accessor out of bounds");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("byteLength": 36)",
                                   R"("byteLength": 36, "byteStride": 8)")),
                  "stride 8 is less than an element");
}

TEST(BadGltf, WrongTypesOfElements) {
  EXPECT_CONTAINS(
      errorOfJson(with(kTriangleJson, R"("componentType": 5125)", R"("componentType": 5126)")),
      "its indices are not unsigned integers");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("type": "VEC3")", R"("type": "VEC2")")),
                  "has 2 components, 3 are needed");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"({"POSITION": 0})", R"({"NORMAL": 0})")),
                  "has no POSITION");
}

TEST(BadGltf, CyclesAndSharedNodes) {
  EXPECT_CONTAINS(
      errorOfJson(with(kTriangleJson, R"("mesh": 0})", R"("mesh": 0, "children": [0]})")),
      "node 0 is reached twice");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("nodes": [0])", R"("nodes": [0, 0])")),
                  "node 0 is reached twice");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("nodes": [0])", R"("nodes": [8])")),
                  "node 8 does not exist");
  EXPECT_CONTAINS(errorOfJson(with(kTriangleJson, R"("scene": 0)", R"("scene": 4)")),
                  "scene 4 does not exist");
}

TEST(BadGltf, JsonBombs) {
  EXPECT_EQ(errorOfJson(with(kTriangleJson, R"("scene": 0)",
                             R"("extras": )" + std::string(100000, '[') + std::string(100000, ']') +
                                 R"(, "scene": 0)")),
            "damaged: its JSON is nested deeper than 64");
  const TempFolder folder;
  EXPECT_EQ(errorOfFile(folder.write("bad.gltf", "]]]]")),
            "damaged: its JSON closes a bracket that was never opened");
  EXPECT_CONTAINS(errorOfFile(folder.write("bad.gltf", "{\"asset\": nonsense}")),
                  "damaged glTF file: ");
}

TEST(BadGltf, NoGeometry) {
  const std::string text = "no geometry: the scene has no triangle to show";
  EXPECT_EQ(errorOfJson(with(kTriangleJson, R"("name": "thing", "mesh": 0)", R"("name": "thing")")),
            text);
  EXPECT_EQ(errorOfJson(with(kTriangleJson, R"("nodes": [0])", R"("nodes": [])")), text);
  EXPECT_EQ(errorOfJson(with(kTriangleJson, R"("indices": 1)", R"("mode": 1, "indices": 1)")),
            text);
  EXPECT_EQ(errorOfGlb(glb(kTriangleJson, Bytes(48, 0))), text);  // only a point
}

TEST(BadGltf, RequiredExtensionIsNamed) {
  EXPECT_EQ(errorOfJson(with(kTriangleJson, R"("scene": 0)",
                             R"("extensionsRequired": ["VENDOR_compression"], "scene": 0)")),
            "needs the glTF extension VENDOR_compression, which is not supported: export without "
            "it");
}

TEST(BadGltf, PathsThatLeadOutside) {
  const TempFolder folder;
  const auto outside = folder.write("secret.bin", triangleBytes());
  const auto scene = [&](const std::string& uri) {
    return errorOfFile(folder.write("scenes/bad.gltf", textWithBuffer(uri)));
  };
  EXPECT_EQ(scene("../secret.bin"),
            "'../secret.bin' leads outside the scene's folder: copy the file there");
  EXPECT_EQ(scene("%2e%2e/secret.bin"),
            "'../secret.bin' leads outside the scene's folder: copy the file there");
  EXPECT_EQ(
      scene(outside.string()),
      "'" + outside.string() +
          "' is not a path beneath the scene's folder: copy the file there and name it relatively");
  EXPECT_CONTAINS(scene("file:///etc/passwd"), "is not a path beneath the scene's folder");
  EXPECT_CONTAINS(scene("https://example.org/x.bin"), "is not a path beneath the scene's folder");
  std::filesystem::create_symlink(outside, folder.path() / "scenes/link.bin");
  EXPECT_EQ(scene("link.bin"), "'link.bin' leads outside the scene's folder: copy the file there");
  std::filesystem::create_directory_symlink(folder.path(), folder.path() / "scenes/up");
  EXPECT_CONTAINS(scene("up/secret.bin"), "leads outside the scene's folder");
}

TEST(BadGltf, OnlyRegularFilesAreOpened) {
  const TempFolder folder;
  const auto scene = folder.write("bad.gltf", textWithBuffer("pipe"));
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(errorOfFile(scene), "'pipe' is not a regular file");
  EXPECT_EQ(errorOfFile(folder.write("bad.gltf", textWithBuffer("."))).find("'.'"), 0u);
  EXPECT_EQ(errorOf([] { readScene("/dev/zero.glb"); }).find("/dev/zero.glb: "), 0u);
}

TEST(BadGltf, MissingBuffer) {
  const TempFolder folder;
  const std::string where = std::filesystem::canonical(folder.path()).string();
  EXPECT_EQ(errorOfFile(folder.write("bad.gltf", textWithBuffer("gone.bin"))),
            "'gone.bin' is missing: put it into the scene's folder " + where);
}

std::string jsonWithImage() {
  return with(kTriangleJson, R"([{"name": "paint"}])",
              R"([{"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
                 "textures": [{"source": 0}], "images": [{"name": "wood", "uri": "wood.png"}])");
}

TEST(BadGltf, MissingTexture) {
  const TempFolder folder;
  const std::string where = std::filesystem::canonical(folder.path()).string();
  EXPECT_EQ(
      errorOfFile(folder.write("bad.glb", triangleGlb(jsonWithImage()))),
      "node 0 'thing': material 0 'paint': image 0 'wood': 'wood.png' is missing: put it into "
      "the scene's folder " +
          where);
}

TEST(BadGltf, ImagesAreSizeCheckedBeforeTheyAreDecoded) {
  const TempFolder folder;
  const auto errorWith = [&](const Bytes& image) {
    folder.write("wood.png", image);
    return errorOfFile(folder.write("bad.glb", triangleGlb(jsonWithImage())));
  };
  const std::string start = "node 0 'thing': material 0 'paint': image 0 'wood': ";
  EXPECT_EQ(errorWith(emptyPng(1000000, 20, 3)),
            start + "1000000 x 20 pixels, more than 16384 on a side: scale it down");
  const Bytes bomb = emptyPng(16000, 16000, 4);
  EXPECT_EQ(errorWith(bomb), start + "truncated: " + std::to_string(bomb.size()) +
                                 " bytes cannot hold 16000 x 16000 pixels");
  EXPECT_EQ(errorWith({'n', 'o', ' ', 'i', 'm', 'a', 'g', 'e'}),
            start + "not a PNG, JPEG, BMP or TGA image: convert it to PNG");
  Bytes damaged = png(8, 8, 3, Bytes(192, 7));
  damaged.resize(damaged.size() / 2);
  EXPECT_EQ(errorWith(damaged), start + "truncated: the PNG ends in the middle");
}

TEST(BadGltf, NumbersOfMaterialsOutOfRange) {
  EXPECT_EQ(
      errorOfJson(with(kTriangleJson, R"({"name": "paint"})",
                       R"({"name": "paint", "extensions": {"KHR_materials_ior": {"ior": -3}}})")),
      "material 0 'paint': its index of refraction is -3, it must lie between 0.0001 and 10000");
  EXPECT_EQ(errorOfJson(with(
                kTriangleJson, R"({"name": "paint"})",
                R"({"name": "paint", "extensions": {"KHR_materials_ior": {"ior": "glass"}}})")),
            "node 0 'thing': material 0 'paint': 'ior' is not a number");
}

TEST(BadGltf, LineBreaksInNamesDoNotBreakTheMessage) {
  EXPECT_EQ(errorOfJson(with(kTriangleJson, R"("name": "thing", "mesh": 0)",
                             R"("name": "two\nlines", "mesh": 9)")),
            "node 0 'two lines': mesh 9 does not exist");
}

}  // namespace
}  // namespace ninefold
