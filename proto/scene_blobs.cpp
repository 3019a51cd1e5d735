#include "proto/scene_blobs.h"

#include <utility>

#include "common/scene/reader.h"
#include "common/scene/texel_ranges.h"
#include "proto/compression.h"
#include "proto/scene_archive.h"

namespace ninefold {
namespace {

constexpr int kLevel = 3;  // a scene is sent rarely, and mostly from cache

Blob seal(BlobKind kind, ByteView raw) {
  if (raw.size() > kMaxBlobBytes)
    fail("scene: one part of it takes {} bytes, at most {} can be sent; split large meshes",
         raw.size(), kMaxBlobBytes);
  return {{sha256(raw), raw.size(), kind}, compressBlob(raw, kLevel)};
}

size_t sizeOf(const Mesh& mesh) {
  return mesh.positions.size() * 12 + mesh.normals.size() * 12 + mesh.uv0.size() * 8 +
         mesh.uv1.size() * 8 + mesh.tangents.size() * 16 + mesh.colors.size() * 16 +
         mesh.triangles.size() * 12 + 128;
}

void packMeshes(const SharedList<Mesh>& meshes, std::vector<Blob>& blobs) {
  Bytes raw;
  WriteArchive archive(raw);
  for (size_t i = 0; i < meshes.size(); ++i) {
    archive(meshes[i]);
    const bool full = i + 1 == meshes.size() || raw.size() + sizeOf(meshes[i + 1]) > kMeshBlobBytes;
    if (!full) continue;
    blobs.push_back(seal(BlobKind::meshes, raw));
    raw.clear();
  }
}

template <typename T>
Bytes bytesOf(const T& value) {
  Bytes raw;
  WriteArchive archive(raw);
  archive(value);
  return raw;
}

ByteReader readerOf(const Bytes& raw) { return ByteReader(raw, "scene blob"); }

template <typename T>
void readOne(const Bytes& raw, T& value) {
  ByteReader in = readerOf(raw);
  ReadArchive archive(in);
  archive(value);
  in.expectEnd();
}

std::shared_ptr<const EnvironmentMap> unpackEnvironment(const Bytes& raw) {
  EnvironmentPicture picture;
  readOne(raw, picture);
  return std::make_shared<const EnvironmentMap>(std::move(picture));
}

void readMeshes(const Bytes& raw, std::vector<Mesh>& meshes) {
  ByteReader in = readerOf(raw);
  ReadArchive archive(in);
  while (in.left() > 0) archive(meshes.emplace_back());
}

}  // namespace

std::vector<Blob> packScene(const Scene& scene) {
  std::vector<Blob> blobs;
  for (const TextureImage& image : scene.images)
    blobs.push_back(seal(BlobKind::image, bytesOf(image)));
  packMeshes(scene.meshes, blobs);
  if (scene.environmentMap)
    blobs.push_back(seal(BlobKind::environment, bytesOf(scene.environmentMap->picture())));
  blobs.push_back(seal(BlobKind::rest, bytesOf(scene)));
  std::vector<BlobInfo> manifest;
  for (const Blob& blob : blobs) manifest.push_back(blob.info);
  checkManifest(manifest);
  return blobs;
}

void checkManifest(const std::vector<BlobInfo>& manifest) {
  if (manifest.empty() || manifest.size() > kMaxBlobs)
    fail("scene: {} parts, must be 1 to {}", manifest.size(), kMaxBlobs);
  uint64_t total = 0, environments = 0;
  for (const BlobInfo& info : manifest) {
    const bool last = &info == &manifest.back();
    if (last != (info.kind == BlobKind::rest)) fail("scene: its parts are out of order");
    if (info.kind == BlobKind::page) fail("scene: a part of it is a page of a state");
    environments += info.kind == BlobKind::environment ? 1 : 0;
    if (environments > 1) fail("scene: it has more than one environment");
    if (info.rawBytes == 0 || info.rawBytes > kMaxBlobBytes)
      fail("scene: a part of {} bytes, must be 1 to {}", info.rawBytes, kMaxBlobBytes);
    total += info.rawBytes;
  }
  if (total > kMaxSceneBytes)
    fail("scene: takes {} bytes, at most {} can be sent", total, kMaxSceneBytes);
}

Bytes unpackBlob(const BlobInfo& info, ByteView compressed) {
  const char* what = info.kind == BlobKind::page ? "state page" : "scene blob";
  if (info.rawBytes > kMaxBlobBytes)
    fail("{}: declares {} bytes, at most {} are allowed", what, info.rawBytes, kMaxBlobBytes);
  Bytes raw;
  try {
    raw = decompressBlob(compressed, info.rawBytes);
  } catch (const Error& error) {
    fail("{} {}: {}", what, hex(info.hash), error.what());
  }
  if (sha256(raw) != info.hash)
    fail("{} {}: its content does not match its SHA-256", what, hex(info.hash));
  return raw;
}

Scene unpackScene(const std::vector<BlobInfo>& manifest, const std::vector<Bytes>& raw) {
  checkManifest(manifest);
  NINEFOLD_CHECK(manifest.size() == raw.size());
  Scene scene;
  readOne(raw.back(), scene);
  std::vector<TextureImage> images;
  std::vector<Mesh> meshes;
  for (size_t i = 0; i + 1 < manifest.size(); ++i) {
    switch (manifest[i].kind) {
      case BlobKind::image:
        readOne(raw[i], images.emplace_back());
        break;
      case BlobKind::environment:
        scene.environmentMap = unpackEnvironment(raw[i]);
        break;
      default:
        readMeshes(raw[i], meshes);
    }
  }
  scene.images = std::move(images), scene.meshes = std::move(meshes);
  validate(scene);
  keepTexelRanges(scene);
  return scene;
}

}  // namespace ninefold
