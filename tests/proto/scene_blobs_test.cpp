#include "proto/scene_blobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "proto/compression.h"

namespace ninefold {
namespace {

Mesh grid(const char* name, int side, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  Mesh mesh;
  mesh.name = name;
  for (int i = 0; i < side * side; ++i) {
    mesh.positions.push_back(
        Vec3(static_cast<float>(i % side), uniform(random), static_cast<float>(i / side)));
    mesh.normals.push_back(Vec3(0, 1, 0));
    mesh.uv0.push_back(Vec2(uniform(random), uniform(random)));
    mesh.tangents.push_back(Vec4(1, 0, 0, -1));
    mesh.colors.push_back(Vec4(0.1f, 0.5f, 1, 0.25f));
  }
  for (uint32_t i = 0; i + 1 < static_cast<uint32_t>(side); ++i)
    mesh.triangles.push_back(Triangle(i, i + 1, i + static_cast<uint32_t>(side)));
  return mesh;
}

DMat4 scaled(double factor) {
  DMat4 matrix(factor);
  matrix[3][3] = 1;
  return matrix;
}

Scene someScene() {
  Scene scene;
  scene.name = "room";
  scene.images.push_back({"wood", 4, 2, 3, true, std::vector<uint8_t>(24, 77)});
  scene.images.push_back({"", 1, 1, 1, false, {255}});
  Material m;
  m.name = "floor";
  m.baseColor = Vec3(0.1f, 0.2f, 0.3f);
  m.baseColorMap = {0, 1, Vec2(1, 2), Vec2(3, 4), 0.5f, Wrap::mirror, Wrap::clamp, true};
  m.alphaMode = AlphaMode::mask;
  m.solid = true, m.doubleSided = true;
  m.transmission = 0.75f;
  scene.materials = {m, Material{}};
  scene.meshes = {grid("small", 4, 1), grid("large", 60, 2), grid("last", 5, 3)};
  scene.meshes[2].normals.clear(), scene.meshes[2].tangents.clear(), scene.meshes[2].uv0.clear();
  Instance instance{"table", 1, 7, scaled(2)};
  scene.instances = {instance, Instance{}};
  scene.photonInstances = {Instance{"box", 2, 3, scaled(4)}};
  scene.lights = {{"lamp", LightKind::spot, Vec3(1), Vec3(0, -1, 0), Vec3(9), 0.1f, 0.2f},
                  {"measured", LightKind::goniometric, Vec3(2), Vec3(0, -1, 0), Vec3(7), 0, 0,
                   Vec3(0, 0, 1), 0}};
  scene.profiles = {{"profile", {0, 30, 90}, {0, 360}, {1, 1, 0.5f, 0.5f, 0, 0.25f}}};
  scene.cameras = {Camera{}};
  scene.environment = Vec3(0.5f);
  EnvironmentPicture sky{"--sky 1:2:3", 4, 2, std::vector<Vec3>(8, Vec3(0.25f)), 0.5f};
  sky.texels[5] = Vec3(1e6f, 0, 2);
  scene.environmentMap = std::make_shared<const EnvironmentMap>(std::move(sky));
  scene.origin = DVec3(1e6, -2, 3);
  scene.bounds.add(Vec3(-1)), scene.bounds.add(Vec3(1));
  return scene;
}

struct Packed {
  std::vector<BlobInfo> manifest;
  std::vector<Bytes> raw;
};

Packed unpackAll(const std::vector<Blob>& blobs) {
  Packed packed;
  for (const Blob& blob : blobs) {
    packed.manifest.push_back(blob.info);
    packed.raw.push_back(unpackBlob(blob.info, blob.compressed));
  }
  return packed;
}

TEST(SceneBlobs, ASceneComesBackBitForBit) {
  const std::vector<Blob> blobs = packScene(someScene());
  const Packed packed = unpackAll(blobs);
  const Scene scene = unpackScene(packed.manifest, packed.raw);
  // All of a scene's bits are in its blobs' names.
  const std::vector<Blob> again = packScene(scene);
  ASSERT_EQ(again.size(), blobs.size());
  for (size_t i = 0; i < blobs.size(); ++i) EXPECT_EQ(again[i].info, blobs[i].info) << i;

  EXPECT_EQ(scene.images[0].texels, someScene().images[0].texels);
  EXPECT_TRUE(scene.images[0].ranges.has_value()) << "a client looks at texels once";
  EXPECT_EQ(scene.materials[0].baseColorMap.wrapS, Wrap::mirror);
  EXPECT_EQ(scene.materials[1].attenuationDistance, std::numeric_limits<float>::infinity());
  EXPECT_EQ(scene.meshes[1].positions, someScene().meshes[1].positions);
  EXPECT_EQ(scene.meshes[2].triangles, someScene().meshes[2].triangles);
  EXPECT_EQ(scene.instances[0].toWorld, scaled(2));
  ASSERT_EQ(scene.photonInstances.size(), 1u);
  EXPECT_EQ(scene.photonInstances[0].toWorld, scaled(4));
  EXPECT_EQ(scene.lights[0].outerCone, 0.2f);
  EXPECT_EQ(scene.lights[1].kind, LightKind::goniometric);
  EXPECT_EQ(scene.lights[1].across, Vec3(0, 0, 1));
  EXPECT_EQ(scene.lights[1].profile, 0);
  ASSERT_EQ(scene.profiles.size(), 1u);
  EXPECT_EQ(scene.profiles[0].name, "profile");
  EXPECT_EQ(scene.profiles[0].vertical, someScene().profiles[0].vertical);
  EXPECT_EQ(scene.profiles[0].horizontal, someScene().profiles[0].horizontal);
  EXPECT_EQ(scene.profiles[0].values, someScene().profiles[0].values);
  EXPECT_EQ(scene.origin, DVec3(1e6, -2, 3));
  ASSERT_TRUE(scene.environmentMap);
  const Scene before = someScene();
  const EnvironmentPicture& sky = scene.environmentMap->picture();
  const EnvironmentPicture& sent = before.environmentMap->picture();
  EXPECT_EQ(sky.name, sent.name);
  EXPECT_EQ(sky.texels, sent.texels);
  EXPECT_EQ(sky.rotation, sent.rotation);
}

TEST(SceneBlobs, EveryFieldOfAMaterialIsInTheName) {
  const std::function<void(Material&)> changes[] = {
      [](Material& m) { m.opacity = 0.1f; },
      [](Material& m) { m.alphaCutoff = 0.1f; },
      [](Material& m) { m.metallic = 0.1f; },
      [](Material& m) { m.roughness = 0.1f; },
      [](Material& m) { m.normalScale = 0.1f; },
      [](Material& m) { m.emission.y = 0.1f; },
      [](Material& m) { m.ior = 1.1f; },
      [](Material& m) { m.specular = 0.1f; },
      [](Material& m) { m.specularColor.z = 0.1f; },
      [](Material& m) { m.attenuationColor.x = 0.1f; },
      [](Material& m) { m.attenuationDistance = 1; },
      [](Material& m) { m.normalMap.image = 1; },
      [](Material& m) { m.emissionMap.image = 1; },
      [](Material& m) { m.transmissionMap.image = 1; },
      [](Material& m) { m.specularMap.image = 1; },
      [](Material& m) { m.specularColorMap.image = 1; },
      [](Material& m) { m.sheenColor.x = 0.1f; },
      [](Material& m) { m.sheenColorMap.image = 1; },
      [](Material& m) { m.sheenRoughness = 0.1f; },
      [](Material& m) { m.sheenRoughnessMap.image = 1; },
      [](Material& m) { m.coat = 0.1f; },
      [](Material& m) { m.coatMap.image = 1; },
      [](Material& m) { m.coatRoughness = 0.1f; },
      [](Material& m) { m.coatRoughnessMap.image = 1; },
      [](Material& m) { m.metallicRoughnessMap.image = 1; },
      [](Material& m) { m.solid = false; }};
  std::vector<Sha256> names{packScene(someScene()).back().info.hash};
  for (const auto& change : changes) {
    Scene scene = someScene();
    change(scene.materials[0]);
    names.push_back(packScene(scene).back().info.hash);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(SceneBlobs, SmallMeshesShareABlobAndALargeOneHasItsOwn) {
  Scene scene = someScene();
  scene.meshes = std::vector<Mesh>(500, grid("m", 3, 1));
  size_t meshBlobs = 0;
  for (const Blob& blob : packScene(scene)) meshBlobs += blob.info.kind == BlobKind::meshes ? 1 : 0;
  EXPECT_EQ(meshBlobs, 1u);
  scene.meshes = {grid("a", 3, 1), grid("huge", 300, 2), grid("b", 3, 3)};
  meshBlobs = 0;
  for (const Blob& blob : packScene(scene)) meshBlobs += blob.info.kind == BlobKind::meshes ? 1 : 0;
  EXPECT_EQ(meshBlobs, 3u);
}

TEST(SceneBlobs, AnEditChangesOnlyItsOwnBlob) {
  Scene scene = someScene();
  const auto before = packScene(scene);
  scene.instances[0].toWorld = scaled(3);
  const auto after = packScene(scene);
  ASSERT_EQ(before.size(), after.size());
  for (size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(before[i].info == after[i].info, i + 1 != before.size());
}

std::string errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SceneBlobs, ContentThatDoesNotMatchItsNameIsRefused) {
  Blob blob = packScene(someScene()).front();
  blob.info.hash[3] ^= 1;
  EXPECT_NE(errorOf([&] { unpackBlob(blob.info, blob.compressed); }).find("SHA-256"),
            std::string::npos);
}

TEST(SceneBlobs, LyingSizesAreRefused) {
  const Blob blob = packScene(someScene()).front();
  for (const int64_t lie : {-1, 1, 1000000}) {
    BlobInfo info = blob.info;
    info.rawBytes = static_cast<uint64_t>(static_cast<int64_t>(info.rawBytes) + lie);
    EXPECT_NE(errorOf([&] { unpackBlob(info, blob.compressed); }), "") << lie;
  }
  BlobInfo huge = blob.info;
  huge.rawBytes = kMaxBlobBytes + 1;
  EXPECT_NE(errorOf([&] { unpackBlob(huge, blob.compressed); }), "");
}

TEST(SceneBlobs, ABombStopsAtTheDeclaredSize) {
  // 256 MiB of zeros in some KiB that claim to be 1000 bytes: stops after one step, see
  // compression.cpp.
  const Bytes bomb = compressBlob(Bytes(256 << 20, std::byte{0}), 1);
  ASSERT_LT(bomb.size(), 100u << 10);
  const std::string text = errorOf([&] { decompressBlob(bomb, 1000); });
  EXPECT_NE(text.find("more than the declared 1000"), std::string::npos) << text;
}

TEST(SceneBlobs, DamagedCompressionIsRefused) {
  const Bytes good = packScene(someScene())[2].compressed;
  const BlobInfo info = packScene(someScene())[2].info;
  EXPECT_NE(errorOf([&] { unpackBlob(info, {}); }), "");
  EXPECT_NE(errorOf([&] { unpackBlob(info, ByteView(good).first(good.size() / 2)); }), "");
  Bytes longer = good;
  longer.push_back(std::byte{0});
  EXPECT_NE(errorOf([&] { unpackBlob(info, longer); }), "");
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    Bytes bad = good;
    bad[random() % bad.size()] ^= static_cast<std::byte>(1 << random() % 8);
    // A flip in a part of the frame that says nothing is harmless: then the content has its name.
    const std::string text = errorOf([&] { EXPECT_EQ(sha256(unpackBlob(info, bad)), info.hash); });
    EXPECT_TRUE(text.empty() || text.starts_with("scene blob")) << text;
  }
}

TEST(SceneBlobs, DamagedContentEndsInAnError) {
  const Packed good = unpackAll(packScene(someScene()));
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    Packed bad = good;
    Bytes& raw = bad.raw[random() % bad.raw.size()];
    const size_t place = random() % std::min<size_t>(raw.size(), 300);  // where the counts are
    raw[place] = static_cast<std::byte>(random());
    if (i % 4 == 0) raw.resize(random() % raw.size());
    errorOf([&] { unpackScene(bad.manifest, bad.raw); });
  }
  Packed cut = good;
  cut.raw.back().pop_back();
  EXPECT_NE(errorOf([&] { unpackScene(cut.manifest, cut.raw); }), "");
  Packed longer = good;
  longer.raw.back().push_back(std::byte{0});
  EXPECT_NE(errorOf([&] { unpackScene(longer.manifest, longer.raw); }), "");
}

TEST(SceneBlobs, ManifestsAreCheckedBeforeAnythingIsFetched) {
  const BlobInfo rest{{}, 10, BlobKind::rest}, image{{}, 10, BlobKind::image};
  EXPECT_EQ(errorOf([&] { checkManifest({image, rest}); }), "");
  EXPECT_NE(errorOf([&] { checkManifest({}); }), "");
  EXPECT_NE(errorOf([&] { checkManifest({image}); }), "") << "no rest";
  EXPECT_NE(errorOf([&] { checkManifest({rest, image}); }), "") << "rest not last";
  EXPECT_NE(errorOf([&] { checkManifest({rest, rest}); }), "");
  const BlobInfo sky{{}, 10, BlobKind::environment};
  EXPECT_EQ(errorOf([&] { checkManifest({sky, rest}); }), "");
  EXPECT_NE(errorOf([&] { checkManifest({sky, sky, rest}); }), "") << "one outside";
  const BlobInfo page{{}, 10, BlobKind::page};
  EXPECT_NE(errorOf([&] { checkManifest({page, rest}); }), "") << "a state is no part of a scene";
  const BlobInfo big{{}, kMaxBlobBytes, BlobKind::image};
  EXPECT_NE(errorOf([&] {
              checkManifest({big, big, big, big, big, rest});
            }),
            "")
      << "too much together";
}

TEST(SceneBlobs, Sha256OfTheStandardsExample) {
  EXPECT_EQ(hex(sha256(viewOf(std::string("abc")))),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace ninefold
