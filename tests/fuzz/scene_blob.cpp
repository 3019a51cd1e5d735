// Any bytes as a scene's raw blobs, and as a compressed blob: a valid scene or an Error. The input
// is cut into an image, meshes and the rest at two places that its first bytes choose.
#include "proto/scene_blobs.h"

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
