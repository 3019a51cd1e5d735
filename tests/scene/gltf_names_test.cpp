// What a glTF file names beside itself: file names as RFC 3986 writes them, data URIs as RFC 2397
// does, images told by their bytes. A buffer that is found gives the triangle; another one would
// not.
#include <gtest/gtest.h>

#include "common/scene/gltf_uri.h"
#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/png_bytes.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

std::string withBuffer(const std::string& uri) {
  return with(kTriangleJson, R"({"byteLength": 48})",
              R"({"byteLength": 48, "uri": ")" + uri + "\"}");
}

// The same triangle, ten times as large: what a wrong file would show.
Bytes otherBytes() {
  Bytes bytes;
  append<float>(bytes, {0, 0, 0, 20, 0, 0, 0, 20, 0});
  append<uint32_t>(bytes, {0, 1, 2});
  return bytes;
}

void expectTriangle(const TempFolder& folder, const std::string& uri) {
  const Scene scene = readScene(folder.write("scene.gltf", withBuffer(uri)));
  EXPECT_EQ(scene.bounds.high, Vec3(1, 1, 0)) << uri;
}

TEST(GltfNames, AreDecodedAsRfc3986SaysAndAPlusIsItself) {
  EXPECT_EQ(percentDecoded("a+b%20c%2Bd%c3%BC"), "a+b c+d\xc3\xbc");
  EXPECT_EQ(percentDecoded("10%.png"), "10%.png");
  EXPECT_EQ(percentDecoded("%"), "%");
  EXPECT_EQ(percentDecoded("a%2"), "a%2");
  EXPECT_EQ(percentDecoded("%zz%4"), "%zz%4");
  EXPECT_EQ(percentDecoded("%2541"), "%41");  // once, not twice
}

TEST(GltfNames, FindTheFileThatIsMeant) {
  for (const auto& [uri, file] : {std::pair("b+1.bin", "b+1.bin"),
                                  {"b%2B1.bin", "b+1.bin"},
                                  {"b%201.bin", "b 1.bin"},
                                  {"b 1.bin", "b 1.bin"},
                                  {"t10%.bin", "t10%.bin"},
                                  {"t10%25.bin", "t10%.bin"},
                                  {"d%C3%BCr/./x.bin", "d\xc3\xbcr/x.bin"},
                                  {"a#1.bin", "a#1.bin"},
                                  {"a?b.bin", "a?b.bin"},
                                  {"\\u0062+1.bin", "b+1.bin"}}) {
    const TempFolder folder;
    folder.write(file, triangleBytes());
    expectTriangle(folder, uri);
  }
}

// Both 't+1.bin' and 't 1.bin' are there: each name gets its own.
TEST(GltfNames, APlusDoesNotTakeTheFileWithABlank) {
  const TempFolder folder;
  folder.write("t+1.bin", triangleBytes());
  folder.write("t 1.bin", otherBytes());
  expectTriangle(folder, "t+1.bin");
}

// Who writes names without encoding them means the file of that very name.
TEST(GltfNames, ThatWereNeverEncodedAreFoundAsWritten) {
  const TempFolder folder;
  folder.write("a%20b.bin", triangleBytes());
  expectTriangle(folder, "a%20b.bin");
  folder.write("a b.bin", triangleBytes());
  folder.write("a%20b.bin", otherBytes());
  expectTriangle(folder, "a%20b.bin");  // but decoded first
}

constexpr const char* kTriangleBase64 =
    "AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAAEAAAAAAAAAAAAEAAAACAAAA";

TEST(GltfNames, DataUrisMayHaveAnyMediaTypeOrNone) {
  const TempFolder folder;
  for (const char* head :
       {"data:;base64,", "data:application/octet-stream;base64,",
        "data:application/gltf-buffer;base64,", "DATA:application/octet-stream;BASE64,",
        "data:application/octet-stream;charset=utf-8;base64,",
        "data:text/plain;charset=US-ASCII;base64,", "data:model/vnd.whatever;base64,",
        "data:Application/Octet-Stream;Base64,"})
    expectTriangle(folder, std::string(head) + kTriangleBase64);
}

TEST(GltfNames, DataUrisMayBePercentEncoded) {
  std::string encoded, percent;
  for (const char* c = kTriangleBase64; *c != 0; ++c)
    encoded += *c == 'A' ? std::string("%41") : std::string(1, *c);
  for (const unsigned char byte : triangleBytes()) {
    char text[4];
    std::snprintf(text, sizeof text, "%%%02X", static_cast<unsigned>(byte));
    percent += text;
  }
  const TempFolder folder;
  expectTriangle(folder, "data:;base64," + encoded);
  expectTriangle(folder, "data:application/octet-stream," + percent);
}

TEST(GltfNames, DamagedDataUrisEndInOneLine) {
  const TempFolder folder;
  const auto error = [&](const std::string& uri) {
    return errorOf([&] { readScene(folder.write("bad.gltf", withBuffer(uri))); });
  };
  EXPECT_CONTAINS(error("data:;base64"), "a data URI has no comma");
  EXPECT_CONTAINS(error("data:;base64,AAAA!AAA"), "not base64 throughout");
  EXPECT_CONTAINS(error("data:;base64,"), "'data:;base64' is empty");
}

std::string withImage(const std::string& image) {
  return with(kTriangleJson, R"([{"name": "paint"}])",
              R"([{"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
                 "textures": [{"source": 0}], "images": [)" +
                  image + "]");
}

// A PNG that calls itself something else is the PNG that it is.
TEST(GltfNames, ImagesAreToldByTheirBytes) {
  const Bytes texels = {10, 20, 30, 40, 50, 60};
  const Bytes image = png(2, 1, 3, texels);
  const TempFolder folder;
  for (const char* name : {"a.png", "a.jpg", "a.dat", "a"}) {
    folder.write(name, image);
    const std::string json =
        withImage(std::string(R"({"mimeType": "image/jpeg", "uri": ")") + name + "\"}");
    EXPECT_EQ(readScene(folder.write("scene.glb", triangleGlb(json))).images[0].texels, texels)
        << name;
  }
  std::string percent;
  for (const unsigned char byte : image) {
    char text[4];
    std::snprintf(text, sizeof text, "%%%02x", static_cast<unsigned>(byte));
    percent += text;
  }
  for (const char* head : {"data:image/jpeg,", "data:,", "data:image/webp;charset=x,"}) {
    const std::string json = withImage(std::string(R"({"uri": ")") + head + percent + "\"}");
    EXPECT_EQ(readScene(folder.write("scene.glb", triangleGlb(json))).images[0].texels, texels)
        << head;
  }
}

// An image that nothing shown uses may be missing, damaged or outside.
TEST(GltfNames, ImagesThatNothingUsesAreNoReasonToRefuse) {
  const TempFolder folder;
  folder.write("damaged.png", Bytes{1, 2, 3});
  folder.write("empty.png", Bytes{});
  for (const char* uri : {"gone.png", "damaged.png", "empty.png", "../up.png",
                          "data:image/png;base64,", "https://example.org/x.png"}) {
    const std::string json =
        with(kTriangleJson, R"([{"name": "paint"}])",
             std::string(R"([{"name": "paint"}, {"name": "unused", "pbrMetallicRoughness":
                 {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
                 "images": [{"uri": ")") +
                 uri + "\"}]");
    EXPECT_EQ(readScene(folder.write("scene.glb", triangleGlb(json))).images.size(), 0u) << uri;
  }
}

}  // namespace
}  // namespace ninefold
