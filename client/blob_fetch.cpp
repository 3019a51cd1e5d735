#include "client/blob_fetch.h"

#include <algorithm>

#include "common/base/error.h"

namespace ninefold {
namespace {

// zstd adds less than 1/128 and a few bytes to what it cannot shrink.
uint64_t largestCompressed(uint64_t rawBytes) { return rawBytes + rawBytes / 128 + 1024; }

}  // namespace

BlobFetch::BlobFetch(std::vector<BlobInfo> missing) : waiting_(std::move(missing)) {
  for (const BlobInfo& blob : waiting_) totalBytes_ += blob.rawBytes;
  std::ranges::reverse(waiting_);
}

std::vector<msg::BlobRequest> BlobFetch::requests() {
  for (; active_.size() < kActive && !waiting_.empty(); waiting_.pop_back())
    active_.push_back({waiting_.back(), {}, 0, false});
  std::vector<msg::BlobRequest> requests;
  for (Part& part : active_) {
    if (part.asked) continue;
    part.asked = true;
    requests.push_back({part.blob.hash, part.compressed.size()});
  }
  return requests;
}

std::optional<BlobFetch::Whole> BlobFetch::chunk(msg::BlobChunk&& chunk) {
  Part& part = partFor(chunk);
  part.asked = false;
  part.total = chunk.total;
  part.compressed.insert(part.compressed.end(), chunk.bytes.begin(), chunk.bytes.end());
  if (part.compressed.size() < part.total) return std::nullopt;
  wholeBytes_ += part.blob.rawBytes;
  Whole whole{part.blob, std::move(part.compressed)};
  active_.erase(active_.begin() + (&part - active_.data()));
  return whole;
}

BlobFetch::Part& BlobFetch::partFor(const msg::BlobChunk& chunk) {
  const auto part = std::ranges::find_if(
      active_, [&](const Part& p) { return p.asked && p.blob.hash == chunk.hash; });
  if (part == active_.end() || chunk.offset != part->compressed.size())
    fail("a piece of the scene came that was not asked for");
  if (chunk.bytes.empty() || chunk.total > largestCompressed(part->blob.rawBytes) ||
      (part->total != 0 && chunk.total != part->total))
    fail("a piece of the scene claims a size that cannot be right");
  return *part;
}

uint64_t BlobFetch::doneBytes() const {
  uint64_t done = wholeBytes_;
  for (const Part& part : active_)
    if (part.total > 0)
      done += static_cast<uint64_t>(static_cast<double>(part.blob.rawBytes) *
                                    static_cast<double>(part.compressed.size()) /
                                    static_cast<double>(part.total));
  return done;
}

}  // namespace ninefold
