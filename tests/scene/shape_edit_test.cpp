// Deformations as values: cut, merged, applied, refused; and the twist.
#include "common/scene/shape_edit.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "common/scene/edit.h"
#include "common/scene/twist.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {
namespace {

constexpr size_t kMany = 2 * ShapePiece::kVertices + 100;

// A strip of many vertices, with normals or without, and the square.
Scene stripAndSquare(bool normals) {
  Scene scene = simpleScene();
  Mesh strip;
  strip.name = "strip";
  for (size_t i = 0; i < kMany; ++i) {
    strip.positions.emplace_back(1e-4f * static_cast<float>(i), i % 2 == 0 ? 0.0f : 1.0f, 0);
    if (normals) strip.normals.emplace_back(0, 0, 1);
  }
  strip.tangents.assign(kMany, Vec4(1, 0, 0, 1));
  for (uint32_t i = 0; i + 2 < kMany; ++i) strip.triangles.emplace_back(i, i + 1, i + 2);
  scene.meshes.push_back(strip);
  Instance instance;
  instance.mesh = 1, instance.node = 1;
  scene.instances.push_back(instance);
  scene.bounds = boundsOf(scene);
  return scene;
}

std::vector<Vec3> shifted(std::vector<Vec3> positions, Vec3 by) {
  for (Vec3& p : positions) p += by;
  return positions;
}

SceneEdit moved(const Scene& scene, uint32_t mesh, Vec3 by) {
  const Mesh& from = scene.meshes[mesh];
  SceneEdit edit;
  edit.shapes = shapeEdits(mesh, shifted(from.positions, by), from.normals);
  return edit;
}

std::string errorOf(const Scene& scene, const SceneEdit& edit) {
  try {
    checkEdit(scene, edit);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(ShapeEdit, APieceChangesItsVerticesAndNothingElse) {
  const Scene scene = stripAndSquare(true);
  SceneEdit edit = moved(scene, 1, Vec3(0, 0, 0.5f));
  ASSERT_EQ(edit.shapes.size(), 3u);
  EXPECT_EQ(edit.shapes[2].vertices->positions.size(), 100u);
  EXPECT_EQ(errorOf(scene, edit), "");
  edit.shapes = {edit.shapes[1]};
  const Scene after = edited(scene, edit);
  const Mesh &was = scene.meshes[1], &is = after.meshes[1];
  for (size_t i = 0; i < kMany; ++i) {
    const bool isInIt = i / ShapePiece::kVertices == 1;
    ASSERT_EQ(is.positions[i], was.positions[i] + (isInIt ? Vec3(0, 0, 0.5f) : Vec3(0)));
  }
  EXPECT_EQ(is.triangles, was.triangles);
  EXPECT_EQ(is.normals, was.normals);
  EXPECT_TRUE(is.tangents.empty()) << "those that were read would not lie along it";
  EXPECT_EQ(&after.meshes[0], &scene.meshes[0]) << "the other mesh is shared, not copied";
  EXPECT_EQ(movedInstances(scene, edit), (std::vector<bool>{false, true}));
  EXPECT_GE(coverBox(after).high.z, 0.5f) << "the cover grows with it";
}

TEST(ShapeEdit, PiecesAreAbsoluteSoThatMergingEqualsFollowing) {
  const Scene scene = stripAndSquare(false);
  SceneEdit all;
  for (int i = 1; i <= 5; ++i) {
    SceneEdit step = moved(scene, 1, Vec3(0, 0, 0.1f * static_cast<float>(i)));
    step.shapes = {step.shapes[static_cast<size_t>(i % 3)]};
    merge(all, step);
    merge(all, step);  // twice is once
  }
  ASSERT_EQ(all.shapes.size(), 3u);
  const Scene after = edited(scene, all);
  EXPECT_EQ(after.meshes[1].positions[0].z, 0.1f * 3);
  EXPECT_EQ(after.meshes[1].positions[ShapePiece::kVertices].z, 0.1f * 4);
  EXPECT_EQ(after.meshes[1].positions.back().z, 0.1f * 5);
  EXPECT_EQ(editOfShape(after, {1, 2}), all.shapes[2]);
}

TEST(ShapeEdit, AShapeThatStaysIsTheSameMesh) {
  const Scene scene = stripAndSquare(true);
  SceneEdit all = moved(scene, 1, Vec3(0, 0, 0.5f));
  const Scene once = edited(scene, all);
  merge(all, moved(scene, 0, Vec3(0.1f, 0, 0)));
  const Scene twice = edited(scene, all, &once);
  EXPECT_EQ(&twice.meshes[1], &once.meshes[1]);
  EXPECT_NE(&twice.meshes[0], &once.meshes[0]);
  EXPECT_NE(twice.meshes[0].shape, once.meshes[0].shape);
  merge(all, moved(scene, 1, Vec3(0)));
  const Scene undone = edited(scene, all, &twice);
  EXPECT_EQ(&undone.meshes[1], &scene.meshes[1]) << "as it was read";
  EXPECT_EQ(undone.meshes[1].shape, 0u);
}

TEST(ShapeEdit, RefusesWhatIsNotThereOrCannotBe) {
  const Scene scene = stripAndSquare(true);
  const Mesh& strip = scene.meshes[1];
  const auto refused = [&](uint32_t mesh, std::vector<Vec3> positions, std::vector<Vec3> normals) {
    SceneEdit edit;
    edit.shapes = shapeEdits(mesh, positions, normals);
    return errorOf(scene, edit);
  };
  EXPECT_EQ(refused(7, strip.positions, strip.normals), "edit: mesh 7 does not exist");
  std::vector<Vec3> few = strip.positions, more = strip.positions;
  few.pop_back(), more.resize(more.size() + ShapePiece::kVertices);
  EXPECT_EQ(refused(1, few, {strip.normals.begin(), strip.normals.end() - 1}),
            "edit: piece 2 of mesh 1 'strip' has 100 vertices, its new shape has 99");
  EXPECT_NE(refused(1, more, strip.normals).find("has 100 vertices"), std::string::npos);
  EXPECT_EQ(refused(1, strip.positions, {}),
            "edit: mesh 1 'strip' was read with normals, its new shape has 0 for 16384 vertices");
  EXPECT_NE(refused(0, scene.meshes[0].positions, {4, Vec3(0, 0, 1)}).find("without normals"),
            std::string::npos);
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), 2e9f}) {
    std::vector<Vec3> positions = strip.positions;
    positions[20000].y = bad;
    EXPECT_NE(refused(1, positions, strip.normals).find("vertex 20000 of mesh 1"),
              std::string::npos);
  }
  std::vector<Vec3> normals = strip.normals;
  normals[3] = Vec3(0, 0, 2);
  EXPECT_NE(refused(1, strip.positions, normals).find("normal of vertex 3"), std::string::npos);
}

TEST(ShapeEdit, RefusesMoreVerticesThanALineHasRoomFor) {
  Scene scene = stripAndSquare(false);
  const size_t vertices = kMaxShapeVertices + 1;
  scene.meshes[1].positions.resize(vertices, Vec3(0));
  EXPECT_NE(errorOf(scene, moved(scene, 1, Vec3(0))).find("at most 524288 can"), std::string::npos);
}

// A tube about the vertical, of rings; the mesh lies turned in its instance.
Scene tube(const DMat4& toWorld) {
  constexpr int kRings = 41, kSides = 48;
  Scene scene = simpleScene();
  Mesh mesh;
  const DMat4 toMesh = glm::inverse(toWorld);
  for (int ring = 0; ring < kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      const double phi = 2 * double{kPi} * side / kSides, radius = 1 + 0.3 * ring / (kRings - 1);
      const DVec3 at(radius * std::cos(phi), 2.0 * ring / (kRings - 1), radius * std::sin(phi));
      const DVec3 n = glm::normalize(DVec3(std::cos(phi), -0.15, std::sin(phi)));
      mesh.positions.emplace_back(DVec3(toMesh * DVec4(at, 1)));
      mesh.normals.emplace_back(glm::normalize(glm::transpose(DMat3(toWorld)) * n));
      if (ring + 1 == kRings) continue;
      const auto a = static_cast<uint32_t>(ring * kSides + side),
                 b = static_cast<uint32_t>(ring * kSides + (side + 1) % kSides);
      mesh.triangles.emplace_back(a, a + kSides, b);
      mesh.triangles.emplace_back(b, a + kSides, b + kSides);
    }
  scene.meshes = {mesh};
  scene.instances[0].toWorld = toWorld;
  scene.bounds = boundsOf(scene);
  return scene;
}

TEST(Twist, TurnsTheTopAgainstTheFootAndNormalsWithTheSurface) {
  const DMat4 toWorld(DVec4(0, 0, 2, 0), DVec4(2, 0, 0, 0), DVec4(0, 2, 0, 0), DVec4(1, 0, 3, 1));
  const Scene scene = tube(toWorld);
  SceneEdit edit;
  edit.shapes = twisted(scene, 0, toWorld, {DVec3(0), 0, 2, 0.5});
  ASSERT_EQ(errorOf(scene, edit), "");
  const Scene after = edited(scene, edit);
  const Mesh& mesh = after.meshes[0];
  EXPECT_EQ(worldPoint(toWorld, mesh.positions[0]),
            worldPoint(toWorld, scene.meshes[0].positions[0]));
  const Vec3 top = worldPoint(toWorld, mesh.positions[40 * 48]);
  EXPECT_NEAR(top.x, 1.3f * std::cos(0.5f), 1e-5f);
  EXPECT_NEAR(top.y, 2, 1e-5f);
  EXPECT_NEAR(top.z, -1.3f * std::sin(0.5f), 1e-5f);
  for (size_t i = 10 * 48; i < 30 * 48; ++i) {
    const auto at = [&](size_t k) { return worldPoint(toWorld, mesh.positions[k]); };
    const Vec3 up = at(i + 48) - at(i - 48),
               along = at(i + 1 - (i % 48 == 47 ? 48 : 0)) - at(i - 1 + (i % 48 == 0 ? 48 : 0));
    const Vec3 surface = glm::normalize(glm::cross(up, along));
    const Vec3 n =
        glm::normalize(Vec3(glm::transpose(DMat3(glm::inverse(toWorld))) * DVec3(mesh.normals[i])));
    ASSERT_GT(std::abs(glm::dot(surface, n)), 0.9999f) << i;
  }
}

}  // namespace
}  // namespace ninefold
