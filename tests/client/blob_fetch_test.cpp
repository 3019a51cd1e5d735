#include "client/blob_fetch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "common/base/error.h"

namespace ninefold {
namespace {

Bytes contentOf(uint8_t name, size_t size) {
  Bytes bytes(size);
  for (size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 31 + name);
  return bytes;
}

BlobInfo infoOf(uint8_t name, size_t size) {
  BlobInfo info;
  info.hash[0] = name;
  info.rawBytes = size;
  return info;
}

msg::BlobChunk pieceOf(const msg::BlobRequest& request, const Bytes& content, size_t most) {
  const size_t size = std::min(most, content.size() - request.offset);
  const auto begin = content.begin() + static_cast<ptrdiff_t>(request.offset);
  return {request.hash, request.offset, content.size(),
          Bytes(begin, begin + static_cast<ptrdiff_t>(size))};
}

TEST(BlobFetch, PutsBlobsTogetherWhateverTheOrderOfAnswers) {
  std::mt19937 random(1);
  std::map<uint8_t, Bytes> contents;
  std::vector<BlobInfo> missing;
  for (uint8_t name = 1; name <= 20; ++name) {
    contents[name] = contentOf(name, 1 + random() % 5000);
    missing.push_back(infoOf(name, contents[name].size()));
  }
  BlobFetch fetch(missing);
  std::vector<msg::BlobRequest> inFlight;
  size_t whole = 0;
  while (!fetch.complete()) {
    for (const auto& request : fetch.requests()) inFlight.push_back(request);
    ASSERT_FALSE(inFlight.empty());
    ASSERT_LE(inFlight.size(), BlobFetch::kActive);
    std::swap(inFlight[random() % inFlight.size()], inFlight.back());
    const msg::BlobRequest request = inFlight.back();
    inFlight.pop_back();
    const Bytes& content = contents[request.hash[0]];
    if (const auto done = fetch.chunk(pieceOf(request, content, 700))) {
      EXPECT_EQ(done->compressed, content);
      ++whole;
    }
  }
  EXPECT_EQ(whole, missing.size());
  EXPECT_EQ(fetch.doneBytes(), fetch.totalBytes());
}

TEST(BlobFetch, NothingMissingIsCompleteAtOnce) {
  EXPECT_TRUE(BlobFetch(std::vector<BlobInfo>()).complete());
}

TEST(BlobFetch, RefusesPiecesThatWereNotAskedFor) {
  BlobFetch fetch({infoOf(1, 100)});
  const Bytes content = contentOf(1, 100);
  const msg::BlobRequest request = fetch.requests().at(0);
  EXPECT_THROW(fetch.chunk({infoOf(2, 100).hash, 0, 100, Bytes(10)}), Error);
  EXPECT_THROW(fetch.chunk({request.hash, 50, 100, Bytes(10)}), Error);
  fetch.chunk(pieceOf(request, content, 10));
  EXPECT_THROW(fetch.chunk(pieceOf(request, content, 10)), Error) << "the same piece twice";
}

TEST(BlobFetch, RefusesSizesThatCannotBeRight) {
  BlobFetch fetch({infoOf(1, 100)});
  const msg::BlobRequest request = fetch.requests().at(0);
  EXPECT_THROW(fetch.chunk({request.hash, 0, 1 << 20, Bytes(10)}), Error)
      << "compressed to much more than the raw bytes";
  EXPECT_THROW(fetch.chunk({request.hash, 0, 100, Bytes()}), Error) << "no progress";
  EXPECT_EQ(fetch.chunk({request.hash, 0, 100, Bytes(10)}), std::nullopt);
  fetch.requests();
  EXPECT_THROW(fetch.chunk({request.hash, 10, 90, Bytes(10)}), Error)
      << "another total than before";
}

}  // namespace
}  // namespace ninefold
