#include "master/output/checkpoint.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "common/base/descriptor.h"
#include "common/base/read_up_to.h"
#include "common/base/written_file.h"
#include "proto/compression.h"
#include "proto/state_wire.h"

namespace ninefold {
namespace {

constexpr std::string_view kMagic = "9foldrun";
constexpr uint32_t kVersion = 1;
constexpr int kLevel = 1;                  // of zstd: means of noise hardly get smaller
constexpr size_t kMostJobBytes = 1 << 16;  // rows are a few kB
constexpr int64_t kMostFrames = 1'000'000'000;
constexpr size_t kPageHeadBytes = 2 + 4 + sizeof(Sha256) + 8 + 8;
constexpr size_t kHeadBytes = kMagic.size() + sizeof kVersion + sizeof(Sha256);

constexpr size_t mostStateBytes(const CheckpointLimits& limits) {
  return limits.hasState ? kMaxStatePages * (kPageHeadBytes + kPageBytes + kPageBytes / 64) : 0;
}

void writeText(std::string_view text, ByteWriter& out) {
  out.number(static_cast<uint32_t>(text.size()));
  out.raw(text.data(), text.size());
}

std::string readText(ByteReader& in) {
  const size_t size = in.count(in.number<uint32_t>("a text"), 1, "a text");
  return std::string(textOf(in.take(size, "a text")));
}

void writeSection(ByteView raw, ByteWriter& out) {
  const Bytes compressed = compressBlob(raw, kLevel);
  out.number(uint64_t{raw.size()});
  out.number(uint64_t{compressed.size()});
  out.raw(compressed.data(), compressed.size());
}

Bytes readSection(ByteReader& in, size_t most, const char* name) {
  const auto raw = in.number<uint64_t>(name);
  if (raw > most) fail("declares {} bytes for its {}, this job has at most {}", raw, name, most);
  const size_t size = in.count(in.number<uint64_t>(name), 1, name);
  return decompressBlob(in.take(size, name), raw);
}

Bytes jobBytes(const Checkpoint& c) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.number(static_cast<uint32_t>(c.job.size()));
  for (const auto& [name, value] : c.job) writeText(name, out), writeText(value, out);
  writeText(c.pixelClass, out), writeText(c.isa, out);
  out.number(uint8_t{c.reproducible});
  out.number(c.frames), out.number(c.seconds), out.number(c.state);
  out.number(static_cast<uint32_t>(c.pages.all().size()));
  return bytes;
}

// Returns the number of pages.
size_t readJob(ByteView bytes, Checkpoint& c) {
  ByteReader in(bytes, "its job");
  const size_t rows = in.count(in.number<uint32_t>("rows"), 2 * sizeof(uint32_t), "rows");
  for (size_t i = 0; i < rows; ++i) {
    std::string name = readText(in);
    c.job.emplace_back(std::move(name), readText(in));
  }
  c.pixelClass = readText(in), c.isa = readText(in);
  c.reproducible = in.number<uint8_t>("reproducible") != 0;
  c.frames = in.number<int64_t>("frames");
  c.seconds = in.number<double>("seconds");
  c.state = in.number<uint32_t>("version");
  const auto pages = in.number<uint32_t>("pages");
  in.expectEnd();
  if (c.frames < 1 || c.frames > kMostFrames) fail("it cannot have {} frames", c.frames);
  if (!(c.seconds >= 0 && std::isfinite(c.seconds))) fail("it cannot have taken {} s", c.seconds);
  if (pages > kMaxStatePages) fail("its state has {} pages, at most {}", pages, kMaxStatePages);
  return pages;
}

Bytes stateBytes(const StatePages& pages) {
  Bytes bytes;
  ByteWriter out(bytes);
  for (const auto& [id, page] : pages.all()) {
    const Blob blob = packPage(id, *page);
    out.number(id.kind), out.number(id.index);
    out.raw(blob.info.hash.data(), blob.info.hash.size());
    out.number(blob.info.rawBytes);
    out.number(uint64_t{blob.compressed.size()});
    out.raw(blob.compressed.data(), blob.compressed.size());
  }
  return bytes;
}

void readState(ByteView bytes, size_t count, StatePages& pages) {
  ByteReader in(bytes, "its state");
  for (size_t i = 0; i < count; ++i) {
    StatePage page;
    page.blob.kind = BlobKind::page;
    page.page.kind = in.number<uint16_t>("kind"), page.page.index = in.number<uint32_t>("index");
    in.raw(page.blob.hash.data(), page.blob.hash.size(), "hash");
    page.blob.rawBytes = in.number<uint64_t>("raw size");
    const size_t size = in.count(in.number<uint64_t>("size"), 1, "page");
    if (pages.find(page.page) != nullptr)
      fail("its state has page {}.{} twice", page.page.kind, page.page.index);
    pages.apply({unpackPage(page, in.take(size, "page"))});
  }
  in.expectEnd();
}

void checkJob(const Checkpoint::Rows& there, const Checkpoint::Rows& here) {
  for (size_t i = 0; i < std::min(there.size(), here.size()); ++i)
    if (there[i] != here[i])
      fail(
          "is of another job: {} is {} there, {} here; give the command that it was made by, or "
          "another file",
          there[i].first, there[i].second, here[i].second);
  if (there.size() != here.size()) fail("is of another job; give another file");
}

// The file's bytes, but not many more than this job's can be.
Bytes contentOf(const Descriptor& fd, const CheckpointLimits& limits) {
  struct stat facts {};
  if (::fstat(fd.get(), &facts) != 0) fail("cannot be read: {}", ::strerror(errno));
  if (!S_ISREG(facts.st_mode)) fail("is no regular file; choose another name");
  const size_t raw = kMostJobBytes + limits.film + mostStateBytes(limits);
  const size_t most = kHeadBytes + raw + raw / 64 + 4096;  // of what zstd cannot make smaller
  if (static_cast<uint64_t>(facts.st_size) > most)
    fail("has {} bytes, this job's has at most {}; it is of another job", facts.st_size, most);
  Bytes bytes(static_cast<size_t>(facts.st_size));
  if (readUpTo(fd.get(), bytes) != bytes.size()) fail("cannot be read: {}", ::strerror(errno));
  return bytes;
}

}  // namespace

Bytes encodeCheckpoint(const Checkpoint& c) {
  Bytes content, file;
  ByteWriter sections(content);
  content.reserve(c.film.size() + kMostJobBytes);
  writeSection(jobBytes(c), sections);
  writeSection(stateBytes(c.pages), sections);
  writeSection(c.film, sections);
  const Sha256 hash = sha256(content);
  ByteWriter out(file);
  file.reserve(kHeadBytes + content.size());
  out.raw(kMagic.data(), kMagic.size());
  out.number(kVersion);
  out.raw(hash.data(), hash.size());
  out.raw(content.data(), content.size());
  return file;
}

Checkpoint decodeCheckpoint(ByteView file, const Checkpoint::Rows& job,
                            const CheckpointLimits& limits) {
  ByteReader in(file, "it");
  if (file.size() < kHeadBytes || textOf(in.take(kMagic.size(), "magic")) != kMagic)
    fail("is no checkpoint; choose another name");
  if (const auto version = in.number<uint32_t>("version"); version != kVersion)
    fail("is of format {}, this release reads {}; give another file", version, kVersion);
  Sha256 hash;
  in.raw(hash.data(), hash.size(), "hash");
  if (sha256(file.subspan(kHeadBytes)) != hash) fail("is damaged; give another file");
  Checkpoint c;
  const size_t pages = readJob(readSection(in, kMostJobBytes, "job"), c);
  checkJob(c.job, job);
  readState(readSection(in, mostStateBytes(limits), "state"), pages, c.pages);
  if ((c.state != 0) != limits.hasState) fail("has not the state of this job");
  c.film = readSection(in, limits.film, "film");
  in.expectEnd();
  return c;
}

std::optional<Checkpoint> readCheckpoint(const std::string& file, const Checkpoint::Rows& job,
                                         const CheckpointLimits& limits) {
  const Descriptor fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!fd && errno == ENOENT) return std::nullopt;
  try {
    if (!fd) fail("cannot be read: {}", ::strerror(errno));
    return decodeCheckpoint(contentOf(fd, limits), job, limits);
  } catch (const Error& error) {
    fail("checkpoint {}: {}", file, error.what());
  }
}

void writeCheckpoint(const std::string& file, const Checkpoint& checkpoint) {
  writeFile(file, textOf(encodeCheckpoint(checkpoint)));
}

}  // namespace ninefold
