// Primitives compressed by Draco: decoded they are what was encoded, within the quantization, and
// what is damaged or claims too much is refused by one line.
#include "common/scene/gltf_draco.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "common/scene/draco_mesh.h"
#include "common/scene/reader.h"
#include "tests/scene/compressed_mesh.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

constexpr int kSequential = 10;  // speed

Scene read(const std::string& json, const Bytes& binary) {
  const TempFolder folder;
  return readScene(folder.write("scene.glb", glb(json, binary)));
}
Scene read(const OneMeshFile& file) { return read(file.json(), file.binary); }

OneMeshFile compressed(const PlainMesh& mesh, int speed) {
  return dracoFile(encodeDraco(mesh, speed), mesh.vertices(), mesh.indices.size());
}

// A corner of a triangle with all that is known of it.
struct Corner {
  Vec3 position, normal;
  Vec2 uv;
};

// The corners of all triangles, in an order that does not depend on numbers of vertices: triangles
// by the middle of their coordinates, each from its corner with the least u, then v.
std::vector<std::array<Corner, 3>> cornersOf(const Mesh& mesh) {
  std::vector<std::array<Corner, 3>> all;
  const auto before = [](Vec2 a, Vec2 b) {
    return std::abs(a.x - b.x) > 1e-3f ? a.x < b.x : a.y < b.y - 1e-3f;
  };
  for (const Triangle& t : mesh.triangles) {
    std::array<Corner, 3> c;
    for (int i = 0; i < 3; ++i)
      c[static_cast<size_t>(i)] = {mesh.positions[t[i]], mesh.normals[t[i]], mesh.uv0[t[i]]};
    while (before(c[1].uv, c[0].uv) || before(c[2].uv, c[0].uv))
      std::rotate(c.begin(), c.begin() + 1, c.end());
    all.push_back(c);
  }
  std::ranges::sort(all, [&](const auto& a, const auto& b) {
    return before((a[0].uv + a[1].uv + a[2].uv) / 3.0f, (b[0].uv + b[1].uv + b[2].uv) / 3.0f);
  });
  return all;
}

// Half a step of the quantization; the octahedron's edges stretch that of normals.
void expectSameWithinSteps(const Mesh& mesh, const Mesh& plain) {
  constexpr float kStep = 1.0f / ((1 << kDracoBits) - 1);
  ASSERT_EQ(mesh.triangles.size(), plain.triangles.size());
  const auto corners = cornersOf(mesh), expected = cornersOf(plain);
  for (size_t i = 0; i < corners.size(); ++i)
    for (size_t c = 0; c < 3; ++c) {
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(corners[i][c].position[axis], expected[i][c].position[axis], 0.51f * kStep);
      for (int axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(corners[i][c].uv[axis], expected[i][c].uv[axis], 0.51f * kStep);
      EXPECT_NEAR(glm::length(corners[i][c].normal - expected[i][c].normal), 0, 3 * kStep);
    }
}

TEST(GltfDraco, BothMethodsGiveTheMeshWithinItsQuantization) {
  for (const uint32_t n : {1u, 7u, 24u}) {
    const PlainMesh mesh = wavyGrid(n);
    const Scene plain = read(plainFile(mesh));
    for (const int speed : {0, 5, kSequential}) {
      const OneMeshFile file = compressed(mesh, speed);
      const Scene scene = read(file);
      ASSERT_EQ(scene.meshes.size(), 1u);
      expectSameWithinSteps(scene.meshes[0], plain.meshes[0]);
      EXPECT_LT(file.binary.size(), std::max<size_t>(plainFile(mesh).binary.size() / 2, 500));
    }
  }
}

TEST(GltfDraco, TextFilesAreReadToo) {
  const OneMeshFile file = compressed(wavyGrid(3), 5);
  const TempFolder folder;
  folder.write("data.bin", file.binary);
  EXPECT_EQ(readScene(folder.write("scene.gltf", file.json("data.bin"))).meshes[0].triangles.size(),
            18u);
}

// The sequential method keeps the order, so targets outside of the stream still fit.
TEST(GltfDraco, MorphTargetsOutsideOfTheStreamMoveItsVertices) {
  const PlainMesh mesh = wavyGrid(4);
  OneMeshFile file = compressed(mesh, kSequential);
  std::vector<float> shifts(mesh.positions.size(), 0.0f);
  for (size_t i = 0; i < shifts.size(); i += 3) shifts[i + 2] = static_cast<float>(i);
  const std::string view = file.addView(file.place(shifts.data(), 4 * shifts.size()));
  file.primitive += R"(, "targets": [{"POSITION": )" +
                    file.addAccessor(view, mesh.vertices(), kFloatType, "VEC3") + "}]";
  file.node = R"(, "weights": [0.5])";
  const Mesh moved = read(file).meshes[0];
  const Mesh still = read(compressed(mesh, kSequential)).meshes[0];
  ASSERT_EQ(moved.positions.size(), still.positions.size());
  for (size_t i = 0; i < moved.positions.size(); ++i) {
    const uint32_t column = static_cast<uint32_t>(std::lround(still.uv0[i].x * 4)),
                   row = static_cast<uint32_t>(std::lround(4 - still.uv0[i].y * 4));
    EXPECT_NEAR(moved.positions[i].z - still.positions[i].z,
                1.5f * static_cast<float>(5 * row + column), 1e-5);
  }
}

std::string errorOfStream(const Bytes& stream) {
  return errorOf([&] { read(dracoFile(stream, 64, 294)); });
}

TEST(GltfDraco, DamagedStreamsAreNamed) {
  const std::string where = "mesh 0 'grid' primitive 0: KHR_draco_mesh_compression: ";
  EXPECT_CONTAINS(errorOfStream(Bytes(40, 7)), where + "is no Draco data: damaged, export anew");
  for (const int speed : {0, 5, kSequential}) {
    const Bytes good = encodeDraco(wavyGrid(7), speed);
    for (size_t kept = 12; kept + 1 < good.size(); kept += good.size() / 9)
      EXPECT_CONTAINS(errorOfStream({good.begin(), good.begin() + static_cast<ptrdiff_t>(kept)}),
                      where + "damaged (");
    Bytes old = good;
    old[6] = 1;
    EXPECT_CONTAINS(errorOfStream(old),
                    where + "is Draco data of version 2.1, only 2.2 is read: export anew");
    Bytes cloud = good;
    cloud[7] = 0;
    EXPECT_CONTAINS(errorOfStream(cloud), where + "is not a mesh: damaged, export anew");
  }
}

// Numbers of Draco lie in bytes of seven bits, the least one first; the highest bit says that
// another follows. The connectivity begins after the header of 11 bytes, for edgebreaker after one
// more: vertices, faces, seams; else faces, points.
TEST(GltfDraco, ClaimsThatNoStreamCanHoldCostNothing) {
  const Bytes huge = {0x80, 0x80, 0x80, 0x80, 0x04};  // 2^30
  Bytes edgebreaker = encodeDraco(wavyGrid(7), 5), sequential = encodeDraco(wavyGrid(7), 10);
  ASSERT_EQ(edgebreaker[12], 64);  // vertices
  ASSERT_EQ(edgebreaker[13], 98);  // faces
  edgebreaker.erase(edgebreaker.begin() + 13);
  edgebreaker.insert(edgebreaker.begin() + 13, huge.begin(), huge.end());
  EXPECT_CONTAINS(errorOfStream(edgebreaker), "cannot hold ");
  ASSERT_EQ(sequential[11], 98);
  ASSERT_EQ(sequential[12], 64);
  sequential.erase(sequential.begin() + 12);
  sequential.insert(sequential.begin() + 12, huge.begin(), huge.end());
  EXPECT_CONTAINS(errorOfStream(sequential), "cannot hold ");
}

TEST(GltfDraco, TheBudgetOfAFileIsKept) {
  const Bytes stream = encodeDraco(wavyGrid(7), 0);
  DracoBudget enough{98 * 3, 64 * 8 * 8};  // two attributes with seams at most
  decodeDracoMesh(stream, enough);
  EXPECT_EQ(enough.faces, 98u * 2);
  EXPECT_EQ(enough.bytes, 0u);
  EXPECT_CONTAINS(errorOf([&] { decodeDracoMesh(stream, enough); }), "too large");
  DracoBudget few{97, 1 << 20};
  EXPECT_CONTAINS(errorOf([&] { decodeDracoMesh(stream, few); }), "too large");
}

TEST(GltfDraco, WhatTheExtensionLacksIsNamed) {
  const OneMeshFile file = compressed(wavyGrid(3), 5);
  const auto error = [&](const std::string& from, const std::string& to) {
    return errorOf([&] { read(with(file.json(), from, to), file.binary); });
  };
  const std::string where = "mesh 0 'grid' primitive 0: KHR_draco_mesh_compression: ";
  EXPECT_CONTAINS(error(R"("NORMAL": 1, "TEXCOORD_0": 2}}})", R"("NORMAL": 9, "TEXCOORD_0": 2}}})"),
                  where + "attribute 9 is not in the Draco data");
  EXPECT_CONTAINS(error(R"({"bufferView": 0, "attributes")", R"({"bufferView": 3, "attributes")"),
                  where + "its data: buffer view 3 does not exist");
  EXPECT_CONTAINS(error(R"("attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}})",
                        R"("attributes": 1}})"),
                  where + "'attributes' is missing");
}

}  // namespace
}  // namespace ninefold
