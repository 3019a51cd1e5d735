#include "common/scene/gltf_guard.h"

#include <cstdint>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr size_t kHeaderBytes = 4 + 4 + 4;
constexpr size_t kChunkHeadBytes = 4 + 4;
constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

uint32_t word(std::span<const unsigned char> file, size_t at) {
  return static_cast<uint32_t>(file[at]) | static_cast<uint32_t>(file[at + 1]) << 8 |
         static_cast<uint32_t>(file[at + 2]) << 16 | static_cast<uint32_t>(file[at + 3]) << 24;
}

// Body of the chunk at `at`, which must be of the given type.
std::span<const unsigned char> chunk(std::span<const unsigned char> file, size_t at, uint32_t type,
                                     const char* name) {
  if (file.size() - at < kChunkHeadBytes) fail("truncated: the {} chunk is missing", name);
  const size_t length = word(file, at);
  if (word(file, at + 4) != type) fail("damaged: the {} chunk is not where it should be", name);
  if (length > file.size() - at - kChunkHeadBytes)
    fail("truncated: the {} chunk has {} bytes, only {} are there", name, length,
         file.size() - at - kChunkHeadBytes);
  return file.subspan(at + kChunkHeadBytes, length);
}

std::span<const unsigned char> jsonChunk(std::span<const unsigned char> file) {
  if (file.size() < kHeaderBytes) fail("truncated: {} bytes are no glTF file", file.size());
  if (word(file, 4) != 2)
    fail("glTF version {} is not supported: export as glTF 2.0", word(file, 4));
  const size_t length = word(file, 8);
  if (length > file.size())
    fail("truncated: the header tells of {} bytes, the file has {}", length, file.size());
  if (length < kHeaderBytes) fail("damaged: the header tells of {} bytes", length);
  file = file.first(length);
  const auto json = chunk(file, kHeaderBytes, kJsonChunk, "JSON");
  const size_t next = kHeaderBytes + kChunkHeadBytes + json.size();
  if (next < file.size()) chunk(file, next, kBinaryChunk, "BIN");
  return json;
}

// Counts nesting and values outside of strings; the grammar itself is left to the parser.
void checkJson(std::string_view text) {
  size_t depth = 0, values = 1;
  bool inString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      inString = c != '"';
    } else if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxJsonDepth)
        fail("damaged: its JSON is nested deeper than {}", kMaxJsonDepth);
      ++values;
    } else if (c == ']' || c == '}') {
      if (depth-- == 0) fail("damaged: its JSON closes a bracket that was never opened");
    } else if (c == ',') {
      ++values;
    }
  }
  if (depth != 0 || inString) fail("truncated: its JSON ends in the middle");
  if (values > kMaxJsonValues)
    fail("its JSON has {} values, more than {}: merge objects", values, kMaxJsonValues);
}

}  // namespace

bool isBinaryGltf(std::span<const unsigned char> file) {
  return file.size() >= 4 && file[0] == 'g' && file[1] == 'l' && file[2] == 'T' && file[3] == 'F';
}

std::string_view checkedJson(std::span<const unsigned char> file) {
  const auto bytes = isBinaryGltf(file) ? jsonChunk(file) : file;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  checkJson(text);
  return text;
}

}  // namespace ninefold
