// scene_blobs.h: a scene as blobs, named by their content, and back, bit for bit.
//
// Each texture image is a blob. Meshes, in order, are gathered into blobs of about kMeshBlobBytes;
// a larger mesh has its own. An environment's picture is one more blob. Everything else (materials,
// instances, lights, cameras, ...) is the last blob. A blob's name is the SHA-256 of its raw bytes:
// a client need not fetch what it has seen, in this scene or another. On the wire and in caches a
// blob is one zstd frame of its raw bytes.
//
// Limits: a blob has at most kMaxBlobBytes raw, a scene kMaxSceneBytes. Decompression takes memory
// only as bytes appear, and stops at the declared size.
// Errors: all throw Error with one line.   Threads: reentrant.   Owner: values.
#pragma once

#include <vector>

#include "common/scene/scene.h"
#include "proto/messages.h"

namespace ninefold {

inline constexpr uint64_t kMaxBlobBytes = 2ull << 30;
inline constexpr uint64_t kMaxSceneBytes = 8ull << 30;
inline constexpr size_t kMeshBlobBytes = 1 << 20;

struct Blob {
  BlobInfo info;
  Bytes compressed;
};

// All blobs of a scene, in the order that unpackScene wants; infos of them make up a SceneOffer.
std::vector<Blob> packScene(const Scene& scene);

// Checks an offered manifest before anything is fetched: sizes, their sum, order of kinds.
void checkManifest(const std::vector<BlobInfo>& manifest);

// Decompresses and verifies size and hash, of any kind of blob. For bytes from the wire and from a
// cache alike.
Bytes unpackBlob(const BlobInfo& info, ByteView compressed);

// Raw blobs in manifest order to a valid scene (validate() of scene/reader.h is called).
Scene unpackScene(const std::vector<BlobInfo>& manifest, const std::vector<Bytes>& raw);

}  // namespace ninefold
