#include "proto/compression.h"

#include <zstd.h>

#include <algorithm>
#include <memory>

namespace ninefold {
namespace {

constexpr size_t kStep = 1 << 20;

}  // namespace

Bytes compressBlob(ByteView raw, int level) {
  // Making one costs more than compressing a few kilobytes.
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                                  ZSTD_freeCCtx);
  Bytes out(ZSTD_compressBound(raw.size()));
  const size_t size =
      ZSTD_compressCCtx(context.get(), out.data(), out.size(), raw.data(), raw.size(), level);
  NINEFOLD_CHECK(ZSTD_isError(size) == 0);
  out.resize(size);
  out.shrink_to_fit();
  return out;
}

Bytes decompressBlob(ByteView compressed, uint64_t declared) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          ZSTD_freeDStream);
  ZSTD_inBuffer in{compressed.data(), compressed.size(), 0};
  Bytes out;
  for (size_t unfinished = 1; unfinished != 0;) {
    const size_t have = out.size();
    // One byte of room beyond the declared size shows whether there is more.
    const uint64_t room = std::min<uint64_t>(kStep, declared + 1 - have);
    out.resize(have + static_cast<size_t>(room));
    ZSTD_outBuffer to{out.data() + have, static_cast<size_t>(room), 0};
    const size_t taken = in.pos;
    unfinished = ZSTD_decompressStream(stream.get(), &to, &in);
    if (ZSTD_isError(unfinished) != 0) fail("compressed data is damaged");
    out.resize(have + to.pos);
    if (out.size() > declared)
      fail("compressed data holds more than the declared {} bytes", declared);
    if (unfinished != 0 && to.pos == 0 && in.pos == taken) fail("compressed data ends too early");
  }
  if (out.size() != declared)
    fail("compressed data holds {} bytes instead of the declared {}", out.size(), declared);
  if (in.pos != in.size) fail("compressed data is followed by something else");
  return out;
}

}  // namespace ninefold
