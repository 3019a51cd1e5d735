// The protocol's number is raised with what is spoken: digests of the messages' text, of tiles, of
// a scene and of a state stand beside it. What is digested here is made by formulas, without
// compression, so that only a change of the format changes it.
#include "proto/wire_version.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "common/scene/settings_table.h"
#include "proto/compression.h"
#include "proto/messages.h"
#include "proto/scene_blobs.h"
#include "proto/state_wire.h"
#include "proto/tile_codec.h"

namespace ninefold {
namespace {

std::string digest(const Bytes& bytes) { return hex(sha256(bytes)).substr(0, 16); }

Bytes bytesOf(const std::string& text) {
  Bytes bytes(text.size());
  std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return std::byte(c); });
  return bytes;
}

void expectRecorded(const std::string& now, std::string_view recorded, const char* what,
                    const char* name) {
  EXPECT_EQ(now, recorded) << what << " changed. In proto/wire_version.h raise kProtocol (now "
                           << kProtocol << ") by one, once for each release, and set " << name
                           << " = \"" << now << "\"; describe the change in proto/PROTOCOL.md.";
}

std::string messagesText() {
  const auto file = std::filesystem::path(NINEFOLD_SCENES).parent_path() / "proto/messages.proto";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  const std::string bare = std::regex_replace(text.str(), std::regex("//[^\n]*"), "");
  std::string all = std::regex_replace(bare, std::regex("\\s+"), " ");
  forEachSetting([&](const auto& row) { all += row.name + std::string(" "); });
  return all;
}

// Ramps over all that a field can hold, a pixel without a surface among them.
void fill(RgbPlane& plane, float scale) {
  for (size_t i = 0; i < plane.r.size(); ++i) {
    const auto x = static_cast<float>(i);
    plane.r[i] = scale * x, plane.g[i] = scale * 0.5f * x, plane.b[i] = scale * 0.25f * x;
  }
}

void fillNormals(RgbPlane& plane) {
  for (size_t i = 1; i < plane.r.size(); ++i) {
    plane.r[i] = i % 2 == 0 ? 1.0f : 0.0f, plane.g[i] = i % 2 == 0 ? 0.0f : 0.6f;
    plane.b[i] = i % 2 == 0 ? 0.0f : -0.8f;
  }
}

TileResult someTile() {
  TileResult tile;
  tile.reset(8, 4, kDiffuseBit | kReflectionBit | kTransmissionBit, kAllExtraPlanes);
  for (LayerPlanes& layer : tile.layers) {
    fill(layer.reflectance, 0.3f / 32), fill(layer.irradiance, 3), fill(layer.unfiltered, 1e-3f);
    fillNormals(layer.normal);
    for (size_t i = 1; i < layer.distance.size(); ++i) {
      layer.distance[i] = 0.5f * static_cast<float>(i);
      layer.chain[i] = static_cast<uint16_t>(1000 * i);
    }
  }
  fill(tile.extras.albedo, 1.0f / 32), fill(tile.extras.caustic, 2),
      fill(tile.extras.irradiance, 5);
  fillNormals(tile.extras.normal);
  for (size_t i = 0; i < tile.extras.depth.size(); ++i) {
    tile.extras.depth[i] = 1 + static_cast<float>(i);
    tile.extras.object[i] = static_cast<uint32_t>(1'000'000 * i);
  }
  return tile;
}

Bytes someTiles() {
  RgbImage radiance;
  radiance.reset(8, 4);
  fill(radiance.pixels, 0.1f);
  TileEncoder encoder;
  Bytes all;
  for (const Bytes& tile :
       {encoder.encode(someTile(), 5, 0).bytes, encoder.encode(radiance, 5, 0).bytes,
        encoder.encode(radiance, ToneMap(0), 0).bytes})
    all.insert(all.end(), tile.begin(), tile.end());
  return all;
}

Scene someScene() {
  Scene scene;
  scene.name = "one of everything";
  scene.images.push_back({"image", 2, 1, 3, true, {1, 2, 3, 4, 5, 6}});
  scene.materials.resize(1);
  Mesh mesh;
  mesh.name = "triangle";
  mesh.positions = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  mesh.normals = {Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1)};
  mesh.uv0 = mesh.uv1 = {Vec2(0), Vec2(1, 0), Vec2(0, 1)};
  mesh.tangents = {Vec4(1, 0, 0, 1), Vec4(1, 0, 0, 1), Vec4(1, 0, 0, 1)};
  mesh.colors = {Vec4(1), Vec4(0.5f), Vec4(0.25f)};
  mesh.triangles = {Triangle(0, 1, 2)};
  scene.meshes.push_back(mesh);
  scene.instances.resize(1);
  scene.photonInstances.resize(1);
  scene.lights.resize(1);
  scene.profiles.push_back({"profile", {0, 90}, {0, 360}, {1, 1, 0.5f, 0.5f}});
  scene.environmentMap = std::make_shared<const EnvironmentMap>(
      EnvironmentPicture{"outside", 2, 1, {Vec3(1, 2, 3), Vec3(4, 5, 6)}, 0.5f});
  scene.cameras.resize(1);
  scene.bounds.add(Vec3(-1)), scene.bounds.add(Vec3(1));
  return scene;
}

Bytes rawBlobsOf(const Scene& scene) {
  Bytes all;
  for (const Blob& blob : packScene(scene)) {
    const Bytes raw = unpackBlob(blob.info, blob.compressed);
    all.insert(all.end(), raw.begin(), raw.end());
  }
  return all;
}

// The head of encoded deltas and what is compressed behind it, then a page of each form.
Bytes someState() {
  const Records records{std::byte{1}, std::byte{2}, std::byte{3}};
  Sums sums(kPageSums, 0);
  sums[0] = -1, sums[4097] = INT64_MAX, sums[8191] = INT64_MIN;
  const Bytes encoded = encodeDeltas(
      {{{1, 2}, records}, {{3, 1'000'000}, std::vector<SumChange>{{8191, 1}, {5, -300}}}});
  Bytes all(encoded.begin(), encoded.begin() + 5);
  ByteReader head(encoded, "head");
  head.take(1, "version");
  const auto size = head.number<uint32_t>("size");
  const Blob pages[] = {packPage({1, 2}, records), packPage({3, 4}, sums)};
  for (const Bytes& raw : {decompressBlob(ByteView(encoded).subspan(5), size),
                           unpackBlob(pages[0].info, pages[0].compressed),
                           unpackBlob(pages[1].info, pages[1].compressed)})
    all.insert(all.end(), raw.begin(), raw.end());
  return all;
}

TEST(WireVersion, IsRaisedWithTheMessages) {
  ASSERT_NE(messagesText().find("message Hello"), std::string::npos);
  expectRecorded(digest(bytesOf(messagesText())), kMessagesDigest, "messages.proto",
                 "kMessagesDigest");
}

TEST(WireVersion, IsRaisedWithTheTiles) {
  expectRecorded(digest(someTiles()), kTilesDigest, "The tiles' format", "kTilesDigest");
}

TEST(WireVersion, IsRaisedWithTheScenes) {
  expectRecorded(digest(rawBlobsOf(someScene())), kScenesDigest, "The scenes' format",
                 "kScenesDigest");
}

TEST(WireVersion, IsRaisedWithTheStates) {
  expectRecorded(digest(someState()), kStatesDigest, "The states' format", "kStatesDigest");
}

}  // namespace
}  // namespace ninefold
