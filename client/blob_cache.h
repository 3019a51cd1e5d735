// blob_cache.h: scene blobs on disk, so that a scene seen before need not be fetched again.
//
// A file holds a blob as it travels (one zstd frame) and is named by the SHA-256 of the raw bytes,
// as computed here; no name ever comes from the wire. Every load decompresses and verifies; a
// damaged file is deleted and counts as absent. Files appear whole (written aside, then renamed).
// When the folder would exceed its bound, the blobs used longest ago go. Private: folder mode 0700,
// files 0600; a folder that others may enter is refused.
// Threads: one at a time; several processes may share a folder.
// Errors: the constructor throws Error; the first failure to write later is a warning: the cache is
// a help only.
#pragma once

#include <filesystem>
#include <optional>

#include "proto/messages.h"

namespace ninefold {

class BlobCache {
 public:
  static constexpr uint64_t kDefaultMaxBytes = 2ull << 30;

  explicit BlobCache(std::filesystem::path folder, uint64_t maxBytes = kDefaultMaxBytes);

  // The raw bytes of a blob, verified.
  std::optional<Bytes> load(const BlobInfo& blob);
  // Keeps a blob that was verified (unpackBlob of proto/scene_blobs.h) before.
  void store(const BlobInfo& verified, ByteView compressed);

  // $XDG_CACHE_HOME/ninefold or ~/.cache/ninefold; nothing if neither variable is set.
  static std::optional<std::filesystem::path> defaultFolder();

 private:
  std::filesystem::path pathOf(const Sha256& hash) const { return folder_ / hex(hash); }
  void makeRoom(uint64_t bytes) const;

  const std::filesystem::path folder_;
  const uint64_t maxBytes_;
  bool toldFull_ = false;
};

}  // namespace ninefold
