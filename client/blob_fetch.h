// blob_fetch.h: which piece of which missing blob to ask for next, and the pieces put together.
// Pure.
//
// Up to kActive blobs are fetched side by side, each with one piece in flight. That keeps a line
// with latency full and both sides' queues short.
// Errors: chunk() throws Error on a piece that was not asked for, or whose size cannot be right.
#pragma once

#include <optional>
#include <vector>

#include "proto/messages.h"

namespace ninefold {

class BlobFetch {
 public:
  static constexpr size_t kActive = 8;

  struct Whole {
    BlobInfo blob;
    Bytes compressed;
  };

  BlobFetch() = default;
  explicit BlobFetch(std::vector<BlobInfo> missing);

  // What to ask for now; each request is given out once.
  std::vector<msg::BlobRequest> requests();
  // The blob that this piece completes, if it does.
  std::optional<Whole> chunk(msg::BlobChunk&& chunk);

  bool complete() const { return waiting_.empty() && active_.empty(); }
  // Raw bytes: the compressed sizes are not known beforehand.
  uint64_t doneBytes() const;
  uint64_t totalBytes() const { return totalBytes_; }

 private:
  struct Part {
    BlobInfo blob;
    Bytes compressed;    // what is here, from the beginning
    uint64_t total = 0;  // compressed size; 0 until the first piece is here
    bool asked = false;
  };
  Part& partFor(const msg::BlobChunk& chunk);

  std::vector<BlobInfo> waiting_;  // last one first
  std::vector<Part> active_;
  uint64_t totalBytes_ = 0;
  uint64_t wholeBytes_ = 0;  // raw bytes of completed blobs
};

}  // namespace ninefold
