// Buffer views compressed by meshoptimizer: decoded they are what was encoded, and what is damaged
// or claims too much is refused by one line.
#include "common/scene/gltf_meshopt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "common/scene/reader.h"
#include "tests/scene/compressed_mesh.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

constexpr int kByteType = 5120, kShortType = 5122, kUnsignedShortType = 5123;

Scene read(const OneMeshFile& file) {
  const TempFolder folder;
  return readScene(folder.write("scene.glb", glb(file.json(), file.binary)));
}

// The encoder may begin a triangle at another of its corners.
std::vector<Triangle> fromSmallest(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles)
    while (t.x > t.y || t.x > t.z) t = {t.y, t.z, t.x};
  std::ranges::sort(triangles, [](const Triangle& a, const Triangle& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  return triangles;
}

void expectSameMesh(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), 1u);
  const Mesh &one = a.meshes[0], &other = b.meshes[0];
  EXPECT_EQ(one.positions, other.positions);
  EXPECT_EQ(one.normals, other.normals);
  EXPECT_EQ(one.uv0, other.uv0);
  EXPECT_EQ(fromSmallest(one.triangles), fromSmallest(other.triangles));
}

TEST(GltfMeshopt, AttributesAndTrianglesAreWhatTheyWere) {
  for (const uint32_t n : {1u, 7u, 40u}) {
    const PlainMesh mesh = wavyGrid(n);
    const Scene plain = read(plainFile(mesh));
    for (const char* name : kMeshoptExtensions) {
      const OneMeshFile file = meshoptFile(mesh, name);
      expectSameMesh(read(file), plain);
      EXPECT_LT(file.binary.size(), std::max<size_t>(plainFile(mesh).binary.size() / 2, 9000));
    }
  }
}

TEST(GltfMeshopt, TextFilesWithoutDataForTheFallbackAreRead) {
  const PlainMesh mesh = wavyGrid(7);
  const OneMeshFile file = meshoptFile(mesh);
  const TempFolder folder;
  folder.write("data.bin", file.binary);
  expectSameMesh(readScene(folder.write("scene.gltf", file.json("data.bin"))),
                 read(plainFile(mesh)));
  const std::string missing = with(file.json("data.bin"), R"("byteLength": 1000000000,)",
                                   R"("byteLength": 1000000000, "uri": "none.bin",)");
  expectSameMesh(readScene(folder.write("other.gltf", missing)), read(plainFile(mesh)));
}

TEST(GltfMeshopt, SequencesOfShortIndicesAreWhatTheyWere) {
  const PlainMesh mesh = wavyGrid(12);
  OneMeshFile file = plainFile(mesh);
  const size_t count = mesh.indices.size();
  const std::string view =
      addMeshoptView(file, encodeSequence(mesh.indices, mesh.vertices()), count, 2, "INDICES");
  file.indices = R"(, "indices": )" + file.addAccessor(view, count, kUnsignedShortType, "SCALAR");
  announceMeshopt(file);
  const Scene scene = read(file), plain = read(plainFile(mesh));
  EXPECT_EQ(scene.meshes[0].triangles, plain.meshes[0].triangles);
}

// Octahedral normals of 8 and of 16 bits; K bits are off by about 2^(1-K).
TEST(GltfMeshopt, OctahedralNormalsAreUnfolded) {
  const PlainMesh mesh = wavyGrid(12);
  const Scene plain = read(plainFile(mesh));
  std::vector<float> four;
  for (size_t i = 0; i < mesh.normals.size(); i += 3)
    four.insert(four.end(), {mesh.normals[i], mesh.normals[i + 1], mesh.normals[i + 2], 0});
  for (const size_t stride : {size_t{4}, size_t{8}}) {
    const bool isByte = stride == 4;
    std::vector<unsigned char> folded(mesh.vertices() * stride);
    meshopt_encodeFilterOct(folded.data(), mesh.vertices(), stride, isByte ? 8 : 16, four.data());
    OneMeshFile file = plainFile(mesh);
    const std::string view =
        addMeshoptView(file, encodeAttributes(folded.data(), mesh.vertices(), stride),
                       mesh.vertices(), stride, "ATTRIBUTES", "OCTAHEDRAL");
    file.attributes = with(
        file.attributes, R"("NORMAL": 1)",
        R"("NORMAL": )" + file.addAccessor(view, mesh.vertices(), isByte ? kByteType : kShortType,
                                           "VEC3", R"(, "normalized": true)"));
    announceMeshopt(file);
    const Scene scene = read(file);
    ASSERT_EQ(scene.meshes[0].normals.size(), mesh.vertices());
    for (size_t i = 0; i < mesh.vertices(); ++i)
      EXPECT_NEAR(glm::length(scene.meshes[0].normals[i] - plain.meshes[0].normals[i]), 0,
                  isByte ? 0.02 : 1e-4);
  }
}

// A float m 2^e with a mantissa of 24 bits is stored as e in the highest byte and m below it.
TEST(GltfMeshopt, ExponentialFloatsAreUnfolded) {
  const PlainMesh mesh = wavyGrid(12);
  std::vector<uint32_t> folded;
  for (const float p : mesh.positions)
    folded.push_back(0xEDu << 24 |
                     (static_cast<uint32_t>(std::lround(std::ldexp(p, 19))) & 0xFFFFFF));  // 2^-19
  OneMeshFile file = plainFile(mesh);
  const std::string view =
      addMeshoptView(file, encodeAttributes(folded.data(), mesh.vertices(), 12), mesh.vertices(),
                     12, "ATTRIBUTES", "EXPONENTIAL");
  file.attributes =
      with(file.attributes, R"("POSITION": 0)",
           R"("POSITION": )" + file.addAccessor(view, mesh.vertices(), kFloatType, "VEC3"));
  announceMeshopt(file);
  const Scene scene = read(file);
  for (size_t i = 0; i < mesh.vertices(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(scene.meshes[0].positions[i][c], mesh.positions[3 * i + static_cast<size_t>(c)],
                  std::ldexp(0.51, -19));
}

TEST(GltfMeshopt, QuaternionsOfCopiesAreUnfolded) {
  const float half = 0.70710678f;
  const std::vector<float> turns = {0, 0, half, half, 0, half, 0, -half};  // about z, y
  std::vector<unsigned char> folded(16);
  meshopt_encodeFilterQuat(folded.data(), 2, 8, 16, turns.data());
  OneMeshFile file = plainFile(wavyGrid(1));
  const std::string view =
      addMeshoptView(file, encodeAttributes(folded.data(), 2, 8), 2, 8, "ATTRIBUTES", "QUATERNION");
  file.node = R"(, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"ROTATION": )" +
              file.addAccessor(view, 2, kShortType, "VEC4", R"(, "normalized": true)") + "}}}";
  announceMeshopt(file);
  const Scene scene = read(file);
  ASSERT_EQ(scene.instances.size(), 2u);
  const auto turned = [&](size_t i, DVec3 d) {
    return DVec3(scene.instances[i].toWorld * DVec4(d, 0));
  };
  EXPECT_NEAR(glm::length(turned(0, {1, 0, 0}) - DVec3(0, 1, 0)), 0, 1e-3);
  EXPECT_NEAR(glm::length(turned(1, {0, 0, 1}) - DVec3(-1, 0, 0)), 0, 1e-3);
}

std::string errorWith(const std::string& from, const std::string& to) {
  OneMeshFile file = meshoptFile(wavyGrid(7));
  const std::string json = with(file.json(), from, to);
  const TempFolder folder;
  return errorOf([&] { readScene(folder.write("scene.glb", glb(json, file.binary))); });
}

TEST(GltfMeshopt, WhatDoesNotFitIsNamed) {
  const std::string where = "buffer view 0: EXT_meshopt_compression: ";
  EXPECT_CONTAINS(errorWith(R"("mode": "ATTRIBUTES")", R"("mode": "LINES")"),
                  where + "the mode 'LINES' is unknown");
  EXPECT_CONTAINS(errorWith(R"("mode": "ATTRIBUTES")", R"("mode": 3)"),
                  where + "'mode' is not a text");
  EXPECT_CONTAINS(errorWith(R"("byteStride": 12, "mode")", R"("byteStride": 10, "mode")"),
                  where + "a byteStride of 10 does not go with the mode ATTRIBUTES");
  EXPECT_CONTAINS(errorWith(R"("byteStride": 12, "mode")", R"("byteStride": 260, "mode")"),
                  where + "a byteStride of 260 does not go with the mode ATTRIBUTES");
  EXPECT_CONTAINS(
      errorWith(R"("mode": "ATTRIBUTES")", R"("mode": "ATTRIBUTES", "filter": "QUATERNION")"),
      where +
          "the filter 'QUATERNION' is unknown or does not go with the mode ATTRIBUTES and "
          "a byteStride of 12");
  EXPECT_CONTAINS(
      errorWith(R"("mode": "ATTRIBUTES")", R"("mode": "ATTRIBUTES", "filter": "COLOR")"),
      where + "the filter 'COLOR' is unknown");
  EXPECT_CONTAINS(errorWith(R"("count": 64, "byteStride": 12)", R"("byteStride": 12)"),
                  where + "'count' is missing or not a number from 0 to 2^31 - 1");
  EXPECT_CONTAINS(errorWith(R"({"EXT_meshopt_compression": {"buffer": 0)",
                            R"({"EXT_meshopt_compression": {"buffer": 7)"),
                  where + "buffer 7 does not exist");
  EXPECT_CONTAINS(
      errorWith(R"("buffer": 0, "byteOffset": 0)", R"("buffer": 0, "byteOffset": 99999)"),
      where + "its compressed data end beyond buffer 0");
}

TEST(GltfMeshopt, ClaimsThatNoDataCanHoldCostNothing) {
  EXPECT_CONTAINS(
      errorWith(R"("count": 64, "byteStride": 12)", R"("count": 2147483647, "byteStride": 12)"),
      " cannot hold 25769803764: damaged, export anew");
}

TEST(GltfMeshopt, ACountThatIsWrongIsNamedAsDamage) {
  const std::string damage =
      "EXT_meshopt_compression: its compressed data are damaged: export anew";
  EXPECT_CONTAINS(errorWith(R"("count": 64, "byteStride": 12)", R"("count": 99, "byteStride": 12)"),
                  damage);
  EXPECT_CONTAINS(errorWith(R"("count": 294, "byteStride": 4)", R"("count": 303, "byteStride": 4)"),
                  damage);
}

TEST(GltfMeshopt, TruncatedAndNewerStreamsAreRefused) {
  const PlainMesh mesh = wavyGrid(7);
  const auto errorOfStream = [&](std::vector<unsigned char> stream) {
    OneMeshFile file = plainFile(mesh);
    const std::string view =
        addMeshoptView(file, stream, mesh.vertices(), 12, "ATTRIBUTES", "", kMeshoptExtensions[1]);
    file.attributes =
        with(file.attributes, R"("POSITION": 0)",
             R"("POSITION": )" + file.addAccessor(view, mesh.vertices(), kFloatType, "VEC3"));
    announceMeshopt(file, kMeshoptExtensions[1]);
    return errorOf([&] { read(file); });
  };
  const std::vector<unsigned char> good =
      encodeAttributes(mesh.positions.data(), mesh.vertices(), 12);
  for (size_t kept = 20; kept + 1 < good.size(); kept += 50)
    EXPECT_CONTAINS(errorOfStream({good.begin(), good.begin() + static_cast<ptrdiff_t>(kept)}),
                    "its compressed data are damaged");
  std::vector<unsigned char> newer = good;
  newer[0] = 0xaf;
  EXPECT_CONTAINS(
      errorOfStream(newer),
      "buffer view 4: KHR_meshopt_compression: compressed by a newer meshoptimizer: export "
      "with EXT_meshopt_compression");
}

}  // namespace
}  // namespace ninefold
