// Skins and morph targets, at rest and while they play. Expected places are worked out by hand.
#include "common/scene/gltf_deform.h"

#include <gtest/gtest.h>

#include <numbers>

#include "common/scene/animation.h"
#include "common/scene/edit.h"
#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kFloat = 5126;

// A file whose only mesh is the triangle (0,0,0) (2,0,0) (0,2,0), with what is put to it.
class DeformedFile {
 public:
  std::string nodes = R"({"name": "thing", "mesh": 0})", roots = "[0]", attributes, targets,
              meshMembers, skins, animations;

  // Text that names the new accessor: its number.
  template <typename T>
  std::string add(const std::vector<T>& values, int componentType, const std::string& type,
                  size_t components, bool normalized = false) {
    while (bytes_.size() % 4 != 0) bytes_.push_back(0);
    views_ += R"(, {"buffer": 0, "byteOffset": )" + std::to_string(bytes_.size()) +
              R"(, "byteLength": )" + std::to_string(sizeof(T) * values.size()) + "}";
    append(bytes_, values);
    accessors_ += R"(, {"bufferView": )" + std::to_string(used_) + R"(, "componentType": )" +
                  std::to_string(componentType) + R"(, "count": )" +
                  std::to_string(values.size() / components) + R"(, "type": ")" + type +
                  R"(", "normalized": )" + (normalized ? "true}" : "false}");
    return std::to_string(used_++);
  }
  std::string vectors(const std::vector<float>& values) { return add(values, kFloat, "VEC3", 3); }
  std::string matrices(const std::vector<float>& values) { return add(values, kFloat, "MAT4", 16); }

  // Joints and weights of set 0 as bytes and floats.
  DeformedFile& bind(const std::vector<uint8_t>& joints, const std::vector<float>& weights) {
    attributes += R"(, "JOINTS_0": )" + add(joints, kUnsignedByte, "VEC4", 4) +
                  R"(, "WEIGHTS_0": )" + add(weights, kFloat, "VEC4", 4);
    return *this;
  }
  DeformedFile& bindAllToJoint0() {
    return bind(std::vector<uint8_t>(12, 0), {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  }
  DeformedFile& move(int node, const std::string& path, const std::string& output) {
    const std::string input = add<float>({0, 1}, kFloat, "SCALAR", 1);
    animations = R"({"channels": [{"sampler": 0, "target": {"node": )" + std::to_string(node) +
                 R"(, "path": ")" + path + R"("}}], "samplers": [{"input": )" + input +
                 R"(, "output": )" + output + "}]}";
    return *this;
  }

  Scene read() const {
    std::string json = with(kTriangleJson, R"({"name": "thing", "mesh": 0})", nodes);
    json = with(json, R"("nodes": [0])", R"("nodes": )" + roots);
    json = with(json, R"({"POSITION": 0})", R"({"POSITION": 0)" + attributes + "}");
    json =
        with(json, R"("material": 0})", R"("material": 0, "targets": [)" + targets + "]}" + more_);
    json = with(json, R"("name": "shape",)", R"("name": "shape", )" + meshMembers);
    json = with(json, R"("type": "SCALAR"})", R"("type": "SCALAR"})" + accessors_);
    json = with(json, R"("byteLength": 12})", R"("byteLength": 12})" + views_);
    json = with(json, R"("buffers": [{"byteLength": 48}])",
                R"("buffers": [{"byteLength": )" + std::to_string(bytes_.size()) +
                    R"(}], "skins": [)" + skins + R"(], "animations": [)" + animations + "]");
    json = with(json, R"(]}],
  "materials")",
                "]}" + moreMeshes_ + R"(],
  "materials")");
    if (targets.empty()) json = with(json, R"(, "targets": [])", "");
    if (skins.empty()) json = with(json, R"(, "skins": [])", "");
    if (animations.empty()) json = with(json, R"(, "animations": [])", "");
    const TempFolder folder;
    return readScene(folder.write("scene.glb", glb(json, bytes_)));
  }
  void addPrimitive(const std::string& json) { more_ += ", " + json; }
  void addMesh(const std::string& json) { moreMeshes_ += ", " + json; }

 private:
  std::string accessors_, views_, more_, moreMeshes_;
  Bytes bytes_ = triangleBytes();
  int used_ = 2;
};

// Where a vertex of an instance stands, in file coordinates.
DVec3 place(const Scene& scene, size_t vertex, size_t instance = 0) {
  const Instance& i = scene.instances.at(instance);
  const Vec3 p = scene.meshes[static_cast<size_t>(i.mesh)].positions.at(vertex);
  return DVec3(i.toWorld * DVec4(DVec3(p), 1)) + scene.origin;
}

void expectNear(DVec3 a, DVec3 b, double tolerance = 1e-6) {
  EXPECT_NEAR(glm::length(a - b), 0, tolerance) << a.x << " " << a.y << " " << a.z;
}

// The mesh's node stands aside, which does not count. Joint 0 at (10, 0, 0); joint 1 on it, 5
// higher and turned by a quarter about z; it was bound at (0, 2, 0).
DeformedFile twoJoints() {
  DeformedFile file;
  file.nodes = R"({"name": "thing", "mesh": 0, "skin": 0, "translation": [100, 0, 0]},
      {"translation": [10, 0, 0], "children": [2]},
      {"translation": [0, 5, 0], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752]},
      {"name": "other"})";
  file.roots = "[0, 1, 3]";
  file.skins = R"({"joints": [1, 2], "inverseBindMatrices": )" +
               file.matrices({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                              1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -2, 0, 1}) +
               "}";
  return file;
}

void expectTwoJoints(const Scene& scene) {
  expectNear(place(scene, 0), DVec3(10, 0, 0));
  // Joint 0: (12, 0, 0). Joint 1: (2, -2, 0), turned (2, 2, 0), there (12, 7, 0).
  expectNear(place(scene, 1), DVec3(12, 3.5, 0));
  expectNear(place(scene, 2), DVec3(10, 5, 0));
}

TEST(GltfSkin, VerticesGoWithTheirJoints) {
  expectTwoJoints(
      twoJoints()
          .bind({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, {1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0})
          .read());
}

TEST(GltfSkin, WeightsOfAnySumAreShares) {
  expectTwoJoints(
      twoJoints()
          .bind({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, {0.1f, 0, 0, 0, 2, 2, 0, 0, 3, 0, 0, 0})
          .read());
}

TEST(GltfSkin, AVertexWithoutWeightHangsOnItsFirstJoint) {
  expectTwoJoints(
      twoJoints()
          .bind({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, {0, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 0, 0, 0})
          .read());
}

TEST(GltfSkin, JointsAreShortsAndWeightsNormalizedIntegersToo) {
  for (const bool saysSo : {true, false}) {  // some files forget to
    DeformedFile file = twoJoints();
    file.attributes =
        R"(, "JOINTS_0": )" +
        file.add<uint16_t>({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, kUnsignedShort, "VEC4", 4) +
        R"(, "WEIGHTS_0": )" +
        file.add<uint8_t>({255, 0, 0, 0, 51, 204, 0, 0, 0, 0, 0, 0}, kUnsignedByte, "VEC4", 4,
                          saysSo);
    const Scene scene = file.read();
    expectNear(place(scene, 1), 0.2 * DVec3(12, 0, 0) + 0.8 * DVec3(12, 7, 0));
    expectNear(place(scene, 2), DVec3(10, 5, 0));
  }
}

TEST(GltfSkin, AllSetsOfJointsCount) {
  DeformedFile file =
      twoJoints().bind(std::vector<uint8_t>(12, 0), {1, 0, 0, 0, 0.25f, 0.25f, 0, 0, 0, 0, 0, 0});
  file.attributes +=
      R"(, "JOINTS_1": )" +
      file.add<uint8_t>({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}, kUnsignedByte, "VEC4", 4) +
      R"(, "WEIGHTS_1": )" +
      file.add<float>({0, 0, 0, 0, 0, 0, 0, 0.5f, 0, 0, 1, 0}, kFloat, "VEC4", 4);
  expectTwoJoints(file.read());
}

TEST(GltfSkin, WithoutInverseBindMatricesTheyAreUnity) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  file.skins = R"({"joints": [2]})";
  const Scene scene = file.read();
  expectNear(place(scene, 1), DVec3(10, 7, 0));
  expectNear(place(scene, 2), DVec3(8, 5, 0));
}

TEST(GltfSkin, ANodeWithoutSkinCarriesAMeshWithJoints) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  file.nodes = R"({"mesh": 0, "translation": [100, 0, 0]})", file.roots = "[0]", file.skins = "";
  expectNear(place(file.read(), 1), DVec3(102, 0, 0));
}

TEST(GltfSkin, FarFromTheOriginNothingIsLost) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  file.nodes = R"({"mesh": 0, "skin": 0}, {"translation": [1000000.001, 0, 0]}, {})";
  file.roots = "[0, 1]";
  const Scene scene = file.read();
  EXPECT_NEAR(place(scene, 0).x, 1000000.001, 1e-6);
  EXPECT_NEAR(place(scene, 1).x, 1000002.001, 1e-6);
}

// Normals by the inverse transpose of diag(1, 2, 1), tangents by the matrix itself.
TEST(GltfSkin, NormalsAndTangentsGoAlong) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  file.nodes = R"({"mesh": 0, "skin": 0}, {"scale": [1, 2, 1]}, {})";
  file.roots = "[0, 1]";
  file.attributes += R"(, "NORMAL": )" + file.vectors({1, 1, 0, 0, 0, 1, 0, 0, 1}) +
                     R"(, "TANGENT": )" +
                     file.add<float>({1, -1, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, kFloat, "VEC4", 4);
  const Mesh mesh = file.read().meshes[0];
  expectNear(DVec3(mesh.normals.at(0)), glm::normalize(DVec3(1, 0.5, 0)));
  expectNear(DVec3(mesh.tangents.at(0)), glm::normalize(DVec3(1, -2, 0)));
  EXPECT_EQ(mesh.tangents[0].w, 1);
  EXPECT_EQ(mesh.tangents[2].w, -1);
}

// diag(-1, 1, 1): the front of the triangle, +z, stays in front, and so does the side of
// bitangents.
TEST(GltfSkin, MirroredMeshesKeepTheirFront) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  file.nodes = R"({"mesh": 0, "skin": 0}, {"scale": [-1, 1, 1]}, {})";
  file.roots = "[0, 1]";
  file.attributes += R"(, "NORMAL": )" + file.vectors({0, 0, 1, 0, 0, 1, 0, 0, 1}) +
                     R"(, "TANGENT": )" +
                     file.add<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, kFloat, "VEC4", 4);
  const Mesh mesh = file.read().meshes[0];
  const Triangle t = mesh.triangles.at(0);
  const Vec3 front = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                mesh.positions[t.z] - mesh.positions[t.x]);
  EXPECT_GT(front.z, 0);
  EXPECT_EQ(mesh.normals.at(0), Vec3(0, 0, 1));
  EXPECT_EQ(mesh.tangents.at(0), Vec4(-1, 0, 0, -1));  // cross(n, t) w = (0, 1, 0), as before
}

TEST(GltfSkin, APartWithoutJointsStandsAtTheNode) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  file.addPrimitive(R"({"attributes": {"POSITION": 0}, "indices": 1})");
  const Scene scene = file.read();
  ASSERT_EQ(scene.instances.size(), 2u);
  expectNear(place(scene, 1, 0), DVec3(12, 0, 0));
  expectNear(place(scene, 1, 1), DVec3(102, 0, 0));
}

TEST(GltfSkin, SaysWhatIsWrong) {
  const auto has = [](const DeformedFile& file, const char* part) {
    EXPECT_CONTAINS(errorOf([&] { file.read(); }), part);
  };
  has(twoJoints().bind({0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}, std::vector<float>(12, 1)),
      "joint 2 does not exist, its skin has 2");
  has(twoJoints().bind(std::vector<uint8_t>(12, 0), {1, 0, 0, 0, 1, 0, 0, 0, NAN, 0, 0, 0}),
      "a weight is not a finite number");
  has(twoJoints().bind(std::vector<uint8_t>(8, 0), std::vector<float>(12, 1)),
      "JOINTS_0 has 2 elements for 3 vertices");
  DeformedFile file = twoJoints();
  const std::string floats = file.add(std::vector<float>(12, 0), kFloat, "VEC4", 4);
  file.attributes = R"(, "JOINTS_0": )" + floats + R"(, "WEIGHTS_0": )" + floats;
  has(file, "JOINTS_0 are not unsigned integers");
  file = twoJoints().bindAllToJoint0();
  file.skins = R"({"joints": [1, 2], "inverseBindMatrices": )" +
               file.matrices(std::vector<float>(16, 1)) + "}";
  has(file, "1 inverseBindMatrices for 2 joints");
  file.skins = R"({"joints": [77]})";
  has(file, "skin 0 '': node 77 does not exist");
  file.skins = R"({"joints": []})";
  has(file, "no joints");
  file.skins = "";
  has(file, "skin 0 does not exist");
}

// Target 0 lifts the triangle by (0, 0, 4), target 1 shifts its second vertex by (8, 0, 0).
DeformedFile twoTargets() {
  DeformedFile file;
  file.targets = R"({"POSITION": )" + file.vectors({0, 0, 4, 0, 0, 4, 0, 0, 4}) +
                 R"(}, {"POSITION": )" + file.vectors({0, 0, 0, 8, 0, 0, 0, 0, 0}) + "}";
  return file;
}

TEST(GltfMorph, TargetsCountByTheMeshsWeights) {
  DeformedFile file = twoTargets();
  expectNear(place(file.read(), 1), DVec3(2, 0, 0));
  file.meshMembers = R"("weights": [0.25, -0.125],)";
  expectNear(place(file.read(), 0), DVec3(0, 0, 1));
  expectNear(place(file.read(), 1), DVec3(1, 0, 1));
}

TEST(GltfMorph, WeightsOfANodeComeFirst) {
  DeformedFile file = twoTargets();
  file.meshMembers = R"("weights": [1, 1],)";
  file.nodes = R"({"mesh": 0, "weights": [0.5, 0]}, {"mesh": 0}, {"mesh": 0, "weights": [0.5, 0]})";
  file.roots = "[0, 1, 2]";
  const Scene scene = file.read();
  expectNear(place(scene, 1, 0), DVec3(2, 0, 2));
  expectNear(place(scene, 1, 1), DVec3(10, 0, 4));
  expectNear(place(scene, 1, 2), DVec3(2, 0, 2));
  EXPECT_EQ(scene.meshes.size(), 2u);  // nodes of the same shape share it
}

TEST(GltfMorph, AllAttributesMorph) {
  DeformedFile file;
  file.meshMembers = R"("weights": [0.5],)";
  file.attributes = R"(, "NORMAL": )" + file.vectors({0, 0, 1, 0, 0, 1, 0, 0, 1}) +
                    R"(, "TANGENT": )" +
                    file.add<float>({1, 0, 0, -1, 1, 0, 0, 1, 1, 0, 0, 1}, kFloat, "VEC4", 4) +
                    R"(, "COLOR_0": )" +
                    file.add<float>({1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 0}, kFloat, "VEC4", 4) +
                    R"(, "TEXCOORD_0": )" + file.add<float>({0, 0, 1, 0, 0, 1}, kFloat, "VEC2", 2);
  file.targets = R"({"NORMAL": )" + file.vectors({2, 0, 0, 0, 0, 0, 0, 0, 0}) + R"(, "TANGENT": )" +
                 file.vectors({0, 2, 0, 0, 0, 0, 0, 0, 0}) + R"(, "COLOR_0": )" +
                 file.add<float>({-1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1}, kFloat, "VEC4", 4) +
                 R"(, "TEXCOORD_0": )" + file.add<float>({0, 4, 0, 0, 0, 0}, kFloat, "VEC2", 2) +
                 "}";
  const Mesh mesh = file.read().meshes[0];
  expectNear(DVec3(mesh.normals.at(0)), glm::normalize(DVec3(1, 0, 1)));
  expectNear(DVec3(mesh.tangents.at(0)), glm::normalize(DVec3(1, 1, 0)));
  EXPECT_EQ(mesh.tangents[0].w, -1);
  EXPECT_EQ(mesh.colors.at(0), Vec4(0.5f, 1, 1, 1));
  EXPECT_EQ(mesh.colors.at(2), Vec4(0, 0, 0, 0.5f));
  EXPECT_EQ(mesh.uv0.at(0), Vec2(0, 2));
}

TEST(GltfMorph, ComesBeforeTheSkin) {
  DeformedFile file = twoTargets().bindAllToJoint0();
  file.nodes = R"({"mesh": 0, "skin": 0, "weights": [0, 1]}, {"scale": [3, 1, 1]})";
  file.roots = "[0, 1]", file.skins = R"({"joints": [1]})";
  expectNear(place(file.read(), 1), DVec3(30, 0, 0));
}

TEST(GltfMorph, SaysWhatIsWrong) {
  DeformedFile file = twoTargets();
  file.meshMembers = R"("weights": [1],)";
  file.targets = R"({"POSITION": )" + file.vectors({0, 0, 4}) + "}";
  EXPECT_CONTAINS(errorOf([&] { file.read(); }), "target POSITION has 1 elements for 3 vertices");
}

// Where the scene's only object has a vertex at a time.
DVec3 placeAt(const Scene& scene, double time, size_t vertex) {
  return place(edited(scene, animationAt(scene, time)), vertex);
}

TEST(DeformedAnimation, VerticesGoWithJointsThatMove) {
  DeformedFile file = twoJoints().bind({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0},
                                       {1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0});
  file.attributes += R"(, "NORMAL": )" + file.vectors({0, 0, 1, 0, 0, 1, 0, 0, 1});
  const Scene scene = file.move(2, "translation", file.vectors({0, 5, 0, 4, 5, 0})).read();
  EXPECT_EQ(whyNotPlayed(scene), "");
  EXPECT_EQ(animationEnd(scene), 1);
  for (size_t vertex = 0; vertex < 3; ++vertex)
    expectNear(placeAt(scene, 0, vertex), place(scene, vertex));
  expectNear(placeAt(scene, 0.5, 0), DVec3(10, 0, 0));
  expectNear(placeAt(scene, 0.5, 1), DVec3(13, 3.5, 0));
  expectNear(placeAt(scene, 1, 2), DVec3(14, 5, 0));
  const SceneEdit edit = animationAt(scene, 1);
  ASSERT_EQ(edit.shapes.size(), 1u);
  for (const Vec3& n : edit.shapes[0].vertices->normals) EXPECT_EQ(n, Vec3(0, 0, 1));
}

// What is above a joint moves it, too.
TEST(DeformedAnimation, VerticesGoWithWhatMovesTheirJoints) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  file.skins = R"({"joints": [2]})";
  const Scene scene = file.move(1, "translation", file.vectors({10, 0, 0, 10, 0, 6})).read();
  expectNear(placeAt(scene, 0.5, 0), DVec3(10, 5, 3));
}

TEST(DeformedAnimation, WeightsMorph) {
  DeformedFile file = twoTargets();
  file.move(0, "weights", file.add<float>({0, 0, 1, 0.5f}, kFloat, "SCALAR", 1));
  const Scene scene = file.read();
  expectNear(placeAt(scene, 0, 1), DVec3(2, 0, 0));
  expectNear(placeAt(scene, 0.5, 1), DVec3(4, 0, 2));
  expectNear(placeAt(scene, 7, 1), DVec3(6, 0, 4));
  EXPECT_EQ(animationEnd(scene), 1);
}

// A mesh that two nodes share, of which one morphs.
TEST(DeformedAnimation, OnlyTheNodeWhoseWeightsMoveMorphs) {
  DeformedFile file = twoTargets();
  file.nodes = R"({"mesh": 0}, {"mesh": 0})", file.roots = "[0, 1]";
  const Scene scene =
      file.move(1, "weights", file.add<float>({0, 0, 1, 0}, kFloat, "SCALAR", 1)).read();
  const Scene later = edited(scene, animationAt(scene, 1));
  expectNear(place(later, 1, 0), DVec3(2, 0, 0));
  expectNear(place(later, 1, 1), DVec3(2, 0, 4));
}

TEST(DeformedAnimation, MorphsComeBeforeTheSkin) {
  DeformedFile file = twoTargets().bindAllToJoint0();
  file.nodes = R"({"mesh": 0, "skin": 0}, {"scale": [3, 1, 1]})";
  file.roots = "[0, 1]", file.skins = R"({"joints": [1]})";
  const Scene scene =
      file.move(0, "weights", file.add<float>({0, 0, 0, 1}, kFloat, "SCALAR", 1)).read();
  expectNear(placeAt(scene, 1, 1), DVec3(30, 0, 0));
}

TEST(DeformedAnimation, WeightsMustFitTheTargets) {
  DeformedFile file = twoTargets();
  for (const auto& weights : {std::vector<float>{0, 0, 0, 1, 1, 1}, {0, 1}, {0, 0, 1}}) {
    DeformedFile wrong = file;
    wrong.move(0, "weights", wrong.add<float>(weights, kFloat, "SCALAR", 1));
    EXPECT_CONTAINS(errorOf([&] { wrong.read(); }), "weights");
  }
}

// A part that stands at the node and one that hangs on joints cannot go two ways at once.
TEST(DeformedAnimation, OfAPartlySkinnedMeshIsSaidToBeImpossible) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  const std::string moves = file.vectors({0, 0, 0, 1, 0, 0});
  EXPECT_EQ(whyNotPlayed(DeformedFile(file).move(0, "translation", moves).read()), "");
  file.addPrimitive(R"({"attributes": {"POSITION": 0}, "indices": 1})");
  EXPECT_CONTAINS(whyNotPlayed(DeformedFile(file).move(0, "translation", moves).read()), "'thing'");
  EXPECT_EQ(whyNotPlayed(DeformedFile(file).move(1, "translation", moves).read()), "");
}

// Its joint has no size at rest, so that nothing is there; other things are.
TEST(DeformedAnimation, WhatIsFlatAtRestStaysAwayWithAWarning) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  file.nodes = R"({"name": "thing", "mesh": 0, "skin": 0}, {"scale": [0, 0, 0]}, {},
      {"name": "other", "mesh": 1})";
  file.roots = "[0, 1, 3]";
  file.addMesh(R"({"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]})");
  file.move(1, "scale", file.vectors({0, 0, 0, 1, 1, 1}));
  testing::internal::CaptureStderr();
  const Scene scene = file.read();
  EXPECT_CONTAINS(testing::internal::GetCapturedStderr(),
                  "'thing': 1 triangles without area in the rest pose stay away while it plays");
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(animationAt(scene, 1).shapes.empty());
}

TEST(DeformedAnimation, OfOtherNodesLeavesShapesAlone) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  const std::string moves = file.vectors({0, 0, 0, 1, 0, 0});
  for (const int node : {0, 3}) {  // the node of a skinned mesh does not move it
    const Scene scene = DeformedFile(file).move(node, "translation", moves).read();
    EXPECT_EQ(whyNotPlayed(scene), "");
    EXPECT_TRUE(animationAt(scene, 1).objects.empty());
    EXPECT_TRUE(animationAt(scene, 1).shapes.empty());
  }
  EXPECT_EQ(whyNotPlayed(file.read()), "nothing is animated in the scene");
}

// Far from the file's origin nothing is lost.
TEST(DeformedAnimation, FarAwayItIsAsExact) {
  DeformedFile file = twoJoints().bindAllToJoint0();
  file.nodes = R"({"name": "thing", "mesh": 0, "skin": 0}, {"translation": [1e7, 0, 0]}, {})";
  file.roots = "[0, 1]", file.skins = R"({"joints": [1]})";
  const Scene scene =
      file.move(1, "translation", file.add<float>({1e7f, 0, 0, 1e7f, 1, 0}, kFloat, "VEC3", 3))
          .read();
  expectNear(placeAt(scene, 0.5, 1), DVec3(1e7 + 2, 0.5, 0), 1e-5);
}

}  // namespace
}  // namespace ninefold
