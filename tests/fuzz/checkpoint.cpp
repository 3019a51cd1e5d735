// Any bytes as a checkpoint file, as what lies behind its hash, and as one of its sections: a
// checkpoint or an Error, and no memory beyond what the job can need.
#include "master/output/checkpoint.h"

#include "proto/compression.h"
#include "proto/sha256.h"
#include "tests/fuzz/fuzz.h"

namespace ninefold {
namespace {

constexpr size_t kHeadBytes = 8 + 4;  // magic, version
constexpr CheckpointLimits kLimits{1 << 12, true};
const Checkpoint::Rows kJob{{"seed", "1"}, {"width", "48"}};

Checkpoint example() {
  Checkpoint c;
  c.job = kJob;
  c.pixelClass = "aaaa", c.isa = "avx2", c.frames = 5, c.seconds = 2.5, c.state = 3;
  c.pages.apply({{{1, 2}, Records(30, std::byte{5})}, {{2, 0}, std::vector<SumChange>{{7, -3}}}});
  c.film = Bytes(1000, std::byte{7});
  return c;
}

void decode(ByteView file) {
  try {
    const Checkpoint c = decodeCheckpoint(file, kJob, kLimits);
    NINEFOLD_CHECK(c.film.size() <= kLimits.film);
    const Checkpoint again = decodeCheckpoint(encodeCheckpoint(c), kJob, kLimits);
    NINEFOLD_CHECK(again.pages.hash() == c.pages.hash());
    NINEFOLD_CHECK(again.film == c.film);
  } catch (const Error&) {
  }
}

// With the right magic, version and hash.
void decodeContent(ByteView content) {
  const Bytes good = encodeCheckpoint(example());
  Bytes file(good.begin(), good.begin() + kHeadBytes);
  const Sha256 hash = sha256(content);
  ByteWriter writer(file);
  writer.raw(hash.data(), hash.size());
  writer.raw(content.data(), content.size());
  decode(file);
}

// The sections of a good file; one of them replaced, before compression.
void decodeSection(size_t which, ByteView raw) {
  const Bytes good = encodeCheckpoint(example());
  ByteReader in(ByteView(good).subspan(kHeadBytes + sizeof(Sha256)), "sections");
  Bytes content;
  ByteWriter out(content);
  for (size_t i = 0; i < 3; ++i) {
    const auto rawBytes = in.number<uint64_t>("raw");
    const ByteView body = in.take(static_cast<size_t>(in.number<uint64_t>("size")), "body");
    const Bytes mine = compressBlob(raw, 1);
    const ByteView used = i == which ? ByteView(mine) : body;
    out.number(i == which ? uint64_t{raw.size()} : rawBytes);
    out.number(uint64_t{used.size()});
    out.raw(used.data(), used.size());
  }
  decodeContent(content);
}

std::vector<uint8_t> seedOf(uint8_t choice, ByteView bytes) {
  std::vector<uint8_t> seed{choice};
  for (const std::byte b : bytes) seed.push_back(static_cast<uint8_t>(b));
  return seed;
}

}  // namespace
}  // namespace ninefold

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  using namespace ninefold;
  const Bytes good = encodeCheckpoint(example());
  const ByteView content = ByteView(good).subspan(kHeadBytes + sizeof(Sha256));
  std::vector<std::vector<uint8_t>> seeds{seedOf(0, good), seedOf(1, content)};
  ByteReader in(content, "sections");
  for (uint8_t i = 0; i < 3; ++i) {
    const auto raw = in.number<uint64_t>("raw");
    const auto size = static_cast<size_t>(in.number<uint64_t>("size"));
    seeds.push_back(
        seedOf(static_cast<uint8_t>(2 + i), decompressBlob(in.take(size, "body"), raw)));
  }
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  if (size == 0) return 0;
  const ByteView bytes = std::as_bytes(std::span(data + 1, size - 1));
  if (data[0] % 5 == 0) decode(bytes);
  if (data[0] % 5 == 1) decodeContent(bytes);
  if (data[0] % 5 >= 2) decodeSection(data[0] % 5 - 2u, bytes);
  return 0;
}
