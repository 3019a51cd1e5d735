// Any bytes as a scene's raw blobs, and as a compressed blob: a valid scene or an Error. The input
// is cut into an image, meshes and the rest at two places that its first bytes choose.
#include "proto/scene_blobs.h"

#include "tests/fuzz/fuzz.h"

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  using namespace ninefold;
  Scene scene;
  scene.images.push_back({"wood", 2, 2, 3, true, std::vector<uint8_t>(12, 77)});
  scene.materials.resize(1);
  Mesh mesh;
  mesh.positions = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  mesh.triangles = {Triangle(0, 1, 2)};
  scene.meshes = {mesh};
  scene.instances.resize(1);
  scene.cameras.resize(1);
  for (const Vec3 p : mesh.positions) scene.bounds.add(p);
  const std::vector<Blob> blobs = packScene(scene);
  const size_t image = blobs[0].info.rawBytes, meshes = blobs[1].info.rawBytes;
  std::vector<uint8_t> whole{static_cast<uint8_t>(image), static_cast<uint8_t>(image >> 8),
                             static_cast<uint8_t>(meshes), static_cast<uint8_t>(meshes >> 8)};
  std::vector<uint8_t> packed(4);
  for (const Blob& blob : blobs)
    for (const std::byte b : unpackBlob(blob.info, blob.compressed))
      whole.push_back(static_cast<uint8_t>(b));
  for (const std::byte b : blobs[2].compressed) packed.push_back(static_cast<uint8_t>(b));
  return {whole, packed};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  if (size < 8) return 0;
  const ByteView bytes = std::as_bytes(std::span(data + 4, size - 4));
  const size_t first = (data[0] | data[1] << 8) % bytes.size();
  const size_t second = first + (data[2] | data[3] << 8) % (bytes.size() - first);
  const ByteView parts[] = {bytes.first(first), bytes.subspan(first, second - first),
                            bytes.subspan(second)};
  const BlobKind kinds[] = {BlobKind::image, BlobKind::meshes, BlobKind::rest};
  std::vector<BlobInfo> manifest;
  std::vector<Bytes> raw;
  for (size_t i = 0; i < 3; ++i) {
    if (parts[i].empty()) continue;
    raw.emplace_back(parts[i].begin(), parts[i].end());
    manifest.push_back({sha256(parts[i]), parts[i].size(), kinds[i]});
  }
  try {
    const Scene scene = unpackScene(manifest, raw);
    NINEFOLD_CHECK(!packScene(scene).empty());
  } catch (const Error&) {
  }
  try {
    unpackBlob({sha256(bytes), size, BlobKind::rest}, bytes);
  } catch (const Error&) {
  }
  return 0;
}
