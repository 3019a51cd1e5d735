#include "client/blob_cache.h"

#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include "common/base/descriptor.h"
#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/read_up_to.h"
#include "common/base/written_file.h"
#include "proto/scene_blobs.h"

namespace ninefold {
namespace {

namespace fs = std::filesystem;

struct Entry {
  fs::path path;
  uint64_t bytes = 0;
  fs::file_time_type used;
};

// All files of the folder, those used longest ago first. Files that vanish meanwhile are left out.
std::vector<Entry> entriesOf(const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    Entry entry{it->path(), it->file_size(gone), it->last_write_time(gone)};
    if (!gone) entries.push_back(std::move(entry));
  }
  std::ranges::sort(entries, {}, &Entry::used);
  return entries;
}

// The whole file, or nothing if it is not there, not a regular file, or larger than `maxBytes`.
std::optional<Bytes> readWhole(const fs::path& path, uint64_t maxBytes) {
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status {};
  if (!fd || ::fstat(fd.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      static_cast<uint64_t>(status.st_size) > maxBytes)
    return std::nullopt;
  Bytes bytes(static_cast<size_t>(status.st_size));
  if (readUpTo(fd.get(), bytes) < bytes.size()) return std::nullopt;
  ::futimens(fd.get(), nullptr);  // used now
  return bytes;
}

}  // namespace

BlobCache::BlobCache(fs::path folder, uint64_t maxBytes)
    : folder_(std::move(folder)), maxBytes_(maxBytes) {
  std::error_code error;
  if (folder_.has_parent_path()) fs::create_directories(folder_.parent_path(), error);
  if (::mkdir(folder_.c_str(), 0700) != 0 && errno != EEXIST)
    fail("cannot make the cache folder {}: {}; choose another with --cache", folder_.string(),
         ::strerror(errno));
  struct stat status {};
  if (::stat(folder_.c_str(), &status) != 0 || !S_ISDIR(status.st_mode))
    fail("{} is not a folder; choose another with --cache", folder_.string());
  if (status.st_uid != ::geteuid() || (status.st_mode & 077) != 0)
    fail("the cache folder {} is not private: chmod 700 it, or choose another with --cache",
         folder_.string());
}

std::optional<Bytes> BlobCache::load(const BlobInfo& blob) {
  const fs::path path = pathOf(blob.hash);
  // zstd adds less than 1/128 and a few bytes to what it cannot shrink.
  const auto compressed = readWhole(path, blob.rawBytes + blob.rawBytes / 128 + 1024);
  try {
    if (compressed) return unpackBlob(blob, *compressed);
  } catch (const Error&) {
    warn("the cached {} is damaged; it is fetched again", path.string());
  }
  std::error_code ignored;
  fs::remove(path, ignored);
  return std::nullopt;
}

void BlobCache::store(const BlobInfo& verified, ByteView compressed) {
  if (compressed.size() > maxBytes_) return;
  makeRoom(compressed.size());
  const fs::path path = pathOf(verified.hash);
  std::error_code ignored;
  fs::remove(path, ignored);  // what is not ours, and a link above all
  try {
    writeFile(path, textOf(compressed), {.mode = 0600});
  } catch (const Error& error) {
    if (!std::exchange(toldFull_, true))
      warn("{}; going on without keeping the scene", error.what());
  }
}

void BlobCache::makeRoom(uint64_t bytes) const {
  const std::vector<Entry> entries = entriesOf(folder_);
  uint64_t total = bytes;
  for (const Entry& entry : entries) total += entry.bytes;
  for (const Entry& entry : entries) {
    if (total <= maxBytes_) return;
    std::error_code ignored;
    if (fs::remove(entry.path, ignored)) total -= entry.bytes;
  }
}

std::optional<fs::path> BlobCache::defaultFolder() {
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && xdg[0] == '/')
    return fs::path(xdg) / "ninefold";
  if (const char* home = std::getenv("HOME"); home != nullptr && home[0] == '/')
    return fs::path(home) / ".cache" / "ninefold";
  return std::nullopt;
}

}  // namespace ninefold
