#include <gtest/gtest.h>

#include "common/scene/reader.h"
#include "common/scene/world.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

Scene read(const Bytes& file) {
  const TempFolder folder;
  return readScene(folder.write("scene.glb", file));
}

Scene readTriangle(const std::string& json = kTriangleJson) { return read(triangleGlb(json)); }

// Corner of an instance's triangle in the file's coordinates.
DVec3 cornerInFile(const Scene& scene, size_t instance, size_t triangle, int corner) {
  const Instance& i = scene.instances[instance];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(i.mesh)];
  const Vec3 p = mesh.positions[mesh.triangles[triangle][corner]];
  return DVec3(i.toWorld * DVec4(DVec3(p), 1)) + scene.origin;
}

TEST(GltfReader, ReadsATriangleAndMovesItsMiddleToTheOrigin) {
  const Scene scene = readTriangle();
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].name, "thing");
  EXPECT_EQ(scene.origin, DVec3(1, 1, 0));
  EXPECT_EQ(scene.bounds.low, Vec3(-1, -1, 0));
  EXPECT_EQ(scene.bounds.high, Vec3(1, 1, 0));
  EXPECT_EQ(cornerInFile(scene, 0, 0, 1), DVec3(2, 0, 0));
}

TEST(GltfReader, TextAndBinaryFilesGiveTheSameScene) {
  const TempFolder folder;
  folder.write("data/my triangle.bin", triangleBytes());
  const auto text =
      folder.write("scene.gltf", with(kTriangleJson, R"({"byteLength": 48})",
                                      R"({"byteLength": 48, "uri": "data/my%20triangle.bin"})"));
  const Scene a = readScene(text), b = readTriangle();
  EXPECT_EQ(a.meshes[0].positions, b.meshes[0].positions);
  EXPECT_EQ(a.meshes[0].triangles, b.meshes[0].triangles);
}

TEST(GltfReader, BuffersMayBeDataUris) {
  const std::string json =
      with(kTriangleJson, R"({"byteLength": 48})",
           R"({"byteLength": 48, "uri": "data:application/octet-stream;base64,)"
           "AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAAEAAAAAAAAAAAAEAAAACAAAA\"}");
  const TempFolder folder;
  const Scene scene = readScene(folder.write("scene.gltf", json));
  EXPECT_EQ(scene.bounds.high, Vec3(1, 1, 0));
}

TEST(GltfReader, NodesMultiplyInDoublePrecisionFarFromTheOrigin) {
  // A child 1 mm aside, 100 km away: floats would have lost it.
  std::string json = with(kTriangleJson, R"({"name": "thing", "mesh": 0})",
                          R"({"mesh": 0, "translation": [100000, 0, 0], "children": [1]},
                             {"mesh": 0, "translation": [0.001, 0, 0]})");
  const Scene scene = readTriangle(json);
  ASSERT_EQ(scene.instances.size(), 2u);
  const Vec3 p(0);
  const float aside =
      worldPoint(scene.instances[1].toWorld, p).x - worldPoint(scene.instances[0].toWorld, p).x;
  EXPECT_NEAR(aside, 0.001, 1e-6);
  EXPECT_NE(scene.instances[0].node, scene.instances[1].node);
}

TEST(GltfReader, ScalesThenRotatesThenTranslates) {
  const Scene scene = readTriangle(with(
      kTriangleJson, R"("mesh": 0})",
      R"("mesh": 0, "scale": [3, 1, 1], "rotation": [0, 0, 0.70710678, 0.70710678], "translation": [5, 0, 0]})"));
  const DVec3 b = cornerInFile(scene, 0, 0, 1);  // (2,0,0) -> (6,0,0) -> (0,6,0) -> (5,6,0)
  EXPECT_NEAR(glm::length(b - DVec3(5, 6, 0)), 0, 1e-6);
}

TEST(GltfReader, PrimitivesOfOneMeshShareTheirNode) {
  const Scene scene = readTriangle(
      with(kTriangleJson, R"({"attributes": {"POSITION": 0}, "indices": 1, "material": 0})",
           R"({"attributes": {"POSITION": 0}, "indices": 1, "material": 0},
              {"attributes": {"POSITION": 0}})"));
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].node, scene.instances[1].node);
  EXPECT_NE(scene.meshes[0].material, scene.meshes[1].material);
}

TEST(GltfReader, OneMeshMayStandInManyPlaces) {
  const Scene scene = readTriangle(with(
      with(
          kTriangleJson, R"({"name": "thing", "mesh": 0})",
          R"({"mesh": 0}, {"mesh": 0, "scale": [-1, 1, 1]}, {"mesh": 0, "translation": [0, 9, 0]})"),
      R"("nodes": [0])", R"("nodes": [0, 1, 2])"));
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_FALSE(mirrors(scene.instances[0].toWorld));
  EXPECT_TRUE(mirrors(scene.instances[1].toWorld));
}

TEST(GltfReader, StripsAndFansKeepTheirWinding) {
  Bytes bytes;
  append<float>(bytes,
                {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});  // a strip that covers the unit square
  const std::string base =
      with(with(kTriangleJson, R"("count": 3, "type": "VEC3")", R"("count": 4, "type": "VEC3")"),
           R"("byteLength": 36)", R"("byteLength": 48)");
  for (const char* mode : {"5", "6"}) {
    const std::string json =
        with(base, R"("indices": 1, "material": 0)", std::string(R"("mode": )") + mode);
    const Scene scene = read(glb(json, bytes));
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.triangles.size(), 2u);
    if (mode[0] == '6')
      continue;  // as a fan the square crosses itself; only the strip is flat and whole
    for (const Triangle& t : mesh.triangles)
      EXPECT_GT(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                           mesh.positions[t.z] - mesh.positions[t.x])
                    .z,
                0);
  }
}

TEST(GltfReader, QuantizedPositionsAreScaledAsTheExtensionSays) {
  Bytes bytes;
  append<int16_t>(bytes, {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 0, 0});  // stride 8
  append<uint32_t>(bytes, {0, 1, 2});
  std::string json = with(kTriangleJson, R"("componentType": 5126)",
                          R"("componentType": 5122, "normalized": true)");
  json = with(json, R"("byteOffset": 0, "byteLength": 36)",
              R"("byteOffset": 0, "byteLength": 24, "byteStride": 8)");
  json = with(json, R"("byteOffset": 36)", R"("byteOffset": 24)");
  json = with(json, R"("byteLength": 48)", R"("byteLength": 36)");
  json =
      with(json, R"("scene": 0)", R"("extensionsRequired": ["KHR_mesh_quantization"], "scene": 0)");
  const Scene scene = read(glb(json, bytes));
  EXPECT_EQ(scene.meshes[0].positions[1], Vec3(1, 0, 0));
  EXPECT_EQ(scene.meshes[0].positions[2], Vec3(0, -1, 0));
}

TEST(GltfReader, SparseAccessorsReplaceSomeElements) {
  Bytes bytes = triangleBytes();
  append<uint16_t>(bytes, {1, 0});  // index 1, padding
  append<float>(bytes, {7, 0, 0});
  std::string json = with(kTriangleJson, R"("count": 3, "type": "VEC3"})",
                          R"("count": 3, "type": "VEC3", "sparse": {"count": 1,
                             "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}}})");
  json = with(
      json, R"({"buffer": 0, "byteOffset": 36, "byteLength": 12})",
      R"({"buffer": 0, "byteOffset": 36, "byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 2},
                 {"buffer": 0, "byteOffset": 52, "byteLength": 12})");
  json = with(json, R"("byteLength": 48)", R"("byteLength": 64)");
  const Scene scene = read(glb(json, bytes));
  EXPECT_EQ(scene.meshes[0].positions[1], Vec3(7, 0, 0));
  EXPECT_EQ(scene.meshes[0].positions[2], Vec3(0, 2, 0));
}

TEST(GltfReader, InstancingExtensionMakesCopiesOfOneNode) {
  Bytes bytes = triangleBytes();
  append<float>(bytes, {10, 0, 0, 0, 20, 0});
  std::string json = with(
      kTriangleJson, R"("mesh": 0})",
      R"("mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}})");
  json = with(
      json, R"("type": "SCALAR"})",
      R"("type": "SCALAR"}, {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"})");
  json = with(
      json, R"({"buffer": 0, "byteOffset": 36, "byteLength": 12})",
      R"({"buffer": 0, "byteOffset": 36, "byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 24})");
  json = with(json, R"("byteLength": 48})", R"("byteLength": 72})");
  const Scene scene = read(glb(json, bytes));
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].node, scene.instances[1].node);
  EXPECT_EQ(cornerInFile(scene, 1, 0, 0), DVec3(0, 20, 0));
}

TEST(GltfReader, OnlyTheDefaultSceneIsRead) {
  const Scene scene = readTriangle(
      with(with(kTriangleJson, R"([{"nodes": [0]}])", R"([{"nodes": [0]}, {"nodes": [1]}])"),
           R"({"name": "thing", "mesh": 0})",
           R"({"name": "first", "mesh": 0}, {"name": "second", "mesh": 0})"));
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].name, "first");
}

TEST(GltfReader, CamerasLookAlongMinusZOfTheirNode) {
  std::string json = with(
      kTriangleJson, R"("mesh": 0})",
      R"("mesh": 0}, {"name": "front", "camera": 0, "translation": [1, 1, 8], "scale": [2, 2, 2]})");
  json = with(json, R"("nodes": [0])", R"("nodes": [0, 1])");
  json = with(
      json, R"("materials")",
      R"("cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}], "materials")");
  const Scene scene = readTriangle(json);
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "front");
  EXPECT_EQ(camera.eye, Vec3(0, 0, 8));  // after recentring
  EXPECT_EQ(camera.forward, Vec3(0, 0, -1));
  EXPECT_FLOAT_EQ(camera.verticalFov, 0.5f);
}

std::string withOrthographic(const std::string& magnification) {
  std::string json = with(kTriangleJson, R"("mesh": 0})",
                          R"("mesh": 0}, {"name": "plan", "camera": 0, "scale": [3, 3, 3],
                             "translation": [0, 0, 5]})");
  json = with(json, R"("nodes": [0])", R"("nodes": [0, 1])");
  return with(json, R"("materials")",
              R"("cameras": [{"type": "orthographic", "orthographic": {"xmag": 9, "ymag": )" +
                  magnification + R"(, "znear": 0, "zfar": 9}}], "materials")");
}

TEST(GltfReader, OrthographicCamerasShowTwiceTheirMagnification) {
  for (const char* magnification : {"1.25", "-1.25"}) {
    const Scene scene = readTriangle(withOrthographic(magnification));
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "plan");
    EXPECT_EQ(scene.cameras[0].forward, Vec3(0, 0, -1));
    EXPECT_FLOAT_EQ(scene.cameras[0].orthographicHeight, 2.5f);
  }
}

TEST(GltfReader, OrthographicCamerasWithoutHeightAreAnError) {
  for (const char* bad : {"0", "1e30"})
    EXPECT_CONTAINS(errorOf([&] { readTriangle(withOrthographic(bad)); }), "camera 'plan'");
}

TEST(GltfReader, PunctualLightsComeWithColourTimesIntensity) {
  std::string json = with(
      kTriangleJson, R"("mesh": 0})",
      R"("mesh": 0}, {"name": "lamp", "translation": [1, 1, 5], "rotation": [-0.70710678, 0, 0, 0.70710678],
                             "extensions": {"KHR_lights_punctual": {"light": 0}}})");
  json = with(json, R"("nodes": [0])", R"("nodes": [0, 1])");
  json = with(
      json, R"("materials")",
      R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 10, "color": [1, 0.5, 0],
                 "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.3}}]}}, "materials")");
  const Scene scene = readTriangle(json);
  ASSERT_EQ(scene.lights.size(), 1u);
  const PunctualLight& light = scene.lights[0];
  EXPECT_EQ(light.kind, LightKind::spot);
  EXPECT_EQ(light.position, Vec3(0, 0, 5));
  EXPECT_NEAR(glm::length(light.direction - Vec3(0, -1, 0)), 0, 1e-6);
  EXPECT_EQ(light.intensity, Vec3(10, 5, 0));
  EXPECT_FLOAT_EQ(light.innerCone, 0.1f);
  EXPECT_EQ(scene.environment, Radiance(0));
}

TEST(GltfReader, WithoutCameraTheSceneIsFramedAndWithoutLightItIsWhiteOutside) {
  testing::internal::CaptureStderr();
  const Scene scene = readTriangle();
  const std::string lines = testing::internal::GetCapturedStderr();
  EXPECT_CONTAINS(lines, "no camera in the file");
  EXPECT_CONTAINS(lines, "no light in the file");
  EXPECT_EQ(scene.environment, Radiance(1));
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  const float tangent = std::tan(0.5f * camera.verticalFov);
  for (const Vec3 p :
       {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(-1, 1, 0)}) {  // all of it is in the picture
    const Vec3 d = p - camera.eye;
    EXPECT_LT(std::abs(d.y), tangent * -d.z);
    EXPECT_LT(std::abs(d.x), tangent * -d.z);
  }
}

TEST(GltfReader, UnusedVerticesAreLeftOut) {
  Bytes bytes;
  std::vector<float> positions(3 * 1000, 5.0f);
  positions[9] = 6, positions[13] = 7;  // vertices 3 and 4
  append(bytes, positions);
  append<uint32_t>(bytes, {3, 4, 999});
  std::string json =
      with(kTriangleJson, R"("count": 3, "type": "VEC3")", R"("count": 1000, "type": "VEC3")");
  json =
      with(json, R"("byteOffset": 0, "byteLength": 36)", R"("byteOffset": 0, "byteLength": 12000)");
  json = with(json, R"("byteOffset": 36)", R"("byteOffset": 12000)");
  json = with(json, R"("byteLength": 48)", R"("byteLength": 12012)");
  const Scene scene = read(glb(json, bytes));
  ASSERT_EQ(scene.meshes[0].positions.size(), 3u);
  EXPECT_EQ(scene.meshes[0].positions[0], Vec3(6, 5, 5));
  EXPECT_EQ(scene.meshes[0].positions[2], Vec3(5, 5, 5));
}

TEST(GltfReader, NormalsBecomeUnitAndZeroOnesGeometric) {
  Bytes bytes = triangleBytes();
  append<float>(bytes, {0, 3, 4, 0, 0, 0, 0, 0, -2});
  std::string json = with(kTriangleJson, R"({"POSITION": 0})", R"({"POSITION": 0, "NORMAL": 2})");
  json = with(
      json, R"("type": "SCALAR"})",
      R"("type": "SCALAR"}, {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC3"})");
  json = with(json, R"("byteLength": 12})",
              R"("byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 36})");
  json = with(json, R"("byteLength": 48})", R"("byteLength": 84})");
  const std::vector<Vec3> normals = read(glb(json, bytes)).meshes[0].normals;
  ASSERT_EQ(normals.size(), 3u);
  EXPECT_NEAR(glm::length(normals[0] - Vec3(0, 0.6f, 0.8f)), 0, 1e-6);
  EXPECT_EQ(normals[1], Vec3(0, 0, 1));
  EXPECT_EQ(normals[2], Vec3(0, 0, -1));
}

TEST(GltfReader, TrianglesWithoutAreaAreLeftOutWithOneWarning) {
  Bytes bytes;
  append<float>(bytes, {0, 0, 0, 2, 0, 0, 0, 2, 0});
  append<uint32_t>(bytes, {0, 1, 2, 0, 1, 1, 2, 2, 0});
  std::string json =
      with(kTriangleJson, R"("count": 3, "type": "SCALAR")", R"("count": 9, "type": "SCALAR")");
  json = with(with(json, R"("byteLength": 12)", R"("byteLength": 36)"), R"("byteLength": 48)",
              R"("byteLength": 72)");
  testing::internal::CaptureStderr();
  const Scene scene = read(glb(json, bytes));
  EXPECT_CONTAINS(testing::internal::GetCapturedStderr(), "2 triangles without area are left out");
  EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
}

TEST(GltfReader, ObjectsScaledToNothingAreLeftOut) {
  const Scene scene = readTriangle(with(with(kTriangleJson, R"({"name": "thing", "mesh": 0})",
                                             R"({"mesh": 0}, {"mesh": 0, "scale": [0, 0, 0]})"),
                                        R"("nodes": [0])", R"("nodes": [0, 1])"));
  EXPECT_EQ(scene.instances.size(), 1u);
}

TEST(GltfReader, DeepHierarchiesAreNoProblem) {
  constexpr int kDepth = 10000;
  std::string nodes;  // node i has child i + 1, the last one holds the mesh
  for (int i = 0; i + 1 < kDepth; ++i) nodes += R"({"children": [)" + std::to_string(i + 1) + "]},";
  const Scene scene = readTriangle(
      with(kTriangleJson, R"({"name": "thing", "mesh": 0})", nodes + R"({"mesh": 0})"));
  EXPECT_EQ(scene.instances.size(), 1u);
}

TEST(GltfReader, OptionalUnknownExtensionsGiveOneWarning) {
  testing::internal::CaptureStderr();
  readTriangle(with(
      kTriangleJson, R"("scene": 0)",
      R"("extensionsUsed": ["KHR_materials_dispersion", "VENDOR_magic", "KHR_materials_ior"], "scene": 0)"));
  const std::string lines = testing::internal::GetCapturedStderr();
  EXPECT_CONTAINS(lines,
                  "left out, as nothing reads it: extensions KHR_materials_dispersion (all colours "
                  "refract alike), VENDOR_magic");
}

}  // namespace
}  // namespace ninefold
