#include "common/scene/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <span>

#include "common/scene/gltf_value.h"
#include "common/scene/reader.h"

namespace ninefold {
namespace {

struct Stream {
  std::span<const unsigned char> data;
  size_t count, stride;
  std::string mode, filter;
  size_t bytes() const { return count * stride; }  // both below 2^31
};

size_t sizeOr(const tinygltf::Value& object, const char* key, int otherwise) {
  const int value = integerOr(object, key, otherwise);
  if (value < 0) fail("'{}' is missing or not a number from 0 to 2^31 - 1", key);
  return static_cast<size_t>(value);
}

std::string textOr(const tinygltf::Value& object, const char* key, const char* otherwise) {
  if (!object.Has(key)) return otherwise;
  const tinygltf::Value& value = object.Get(key);
  if (!value.IsString()) fail("'{}' is not a text", key);
  return value.Get<std::string>();
}

Stream streamOf(const tinygltf::Model& model, const tinygltf::Value& e) {
  const size_t buffer = sizeOr(e, "buffer", -1), offset = sizeOr(e, "byteOffset", 0),
               size = sizeOr(e, "byteLength", -1);
  if (buffer >= model.buffers.size()) fail("buffer {} does not exist", buffer);
  const std::vector<unsigned char>& data = model.buffers[buffer].data;
  if (offset > data.size() || size > data.size() - offset)
    fail("its compressed data end beyond buffer {} of {} bytes", buffer, data.size());
  return {std::span(data).subspan(offset, size), sizeOr(e, "count", -1),
          sizeOr(e, "byteStride", -1), textOr(e, "mode", ""), textOr(e, "filter", "NONE")};
}

// What the library takes for granted.
void checkShape(const Stream& s) {
  const bool isIndex = s.mode == "TRIANGLES" || s.mode == "INDICES";
  if (!isIndex && s.mode != "ATTRIBUTES") fail("the mode '{}' is unknown", s.mode);
  const bool fits = isIndex ? s.stride == 2 || s.stride == 4
                            : s.stride % 4 == 0 && s.stride > 0 && s.stride <= 256;
  if (!fits) fail("a byteStride of {} does not go with the mode {}", s.stride, s.mode);
  if (s.mode == "TRIANGLES" && s.count % 3 != 0)
    fail("{} indices are no multiple of three", s.count);
  if (s.filter == "NONE") return;
  const bool filtered = (s.filter == "OCTAHEDRAL" && (s.stride == 4 || s.stride == 8)) ||
                        (s.filter == "QUATERNION" && s.stride == 8) || s.filter == "EXPONENTIAL";
  if (isIndex || !filtered)
    fail("the filter '{}' is unknown or does not go with the mode {} and a byteStride of {}",
         s.filter, s.mode, s.stride);
}

int decode(const Stream& s, unsigned char* out) {
  if (s.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(out, s.count, s.stride, s.data.data(), s.data.size());
  if (s.mode == "INDICES")
    return meshopt_decodeIndexSequence(out, s.count, s.stride, s.data.data(), s.data.size());
  return meshopt_decodeVertexBuffer(out, s.count, s.stride, s.data.data(), s.data.size());
}

void applyFilter(const Stream& s, unsigned char* out) {
  if (s.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out, s.count, s.stride);
  if (s.filter == "QUATERNION") meshopt_decodeFilterQuat(out, s.count, s.stride);
  if (s.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out, s.count, s.stride);
}

// The upper half of the first byte is the kind of the stream, the lower half its version.
bool isNewer(const Stream& s) {
  return s.mode == "ATTRIBUTES" && !s.data.empty() && s.data[0] > 0xa0 && s.data[0] <= 0xaf;
}

std::vector<unsigned char> decoded(const Stream& s, uint64_t& bytesLeft) {
  checkShape(s);
  if (s.bytes() / kMostExpansion > s.data.size())
    fail("{} bytes cannot hold {}: damaged, export anew", s.data.size(), s.bytes());
  if (s.bytes() > bytesLeft)
    fail("the file's compressed data hold more than {} bytes: split or simplify the scene",
         kMaxFileBytes);
  bytesLeft -= s.bytes();
  std::vector<unsigned char> out(s.bytes());
  if (out.empty()) return out;
  if (decode(s, out.data()) != 0)
    fail("{}", isNewer(s)
                   ? "compressed by a newer meshoptimizer: export with EXT_meshopt_compression"
                   : "its compressed data are damaged: export anew");
  applyFilter(s, out.data());
  return out;
}

void decodeView(tinygltf::Model& model, tinygltf::BufferView& view, const tinygltf::Value& e,
                uint64_t& bytesLeft) {
  const Stream stream = streamOf(model, e);
  tinygltf::Buffer plain;
  plain.data = decoded(stream, bytesLeft);
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteOffset = 0, view.byteLength = plain.data.size();
  view.byteStride = stream.mode == "ATTRIBUTES" ? stream.stride : 0;
  model.buffers.push_back(std::move(plain));
}

}  // namespace

void decodeMeshopt(tinygltf::Model& model) {
  uint64_t bytesLeft = kMaxFileBytes;
  for (size_t i = 0; i < model.bufferViews.size(); ++i)
    for (const char* name : kMeshoptExtensions)
      if (const auto* e = extensionOf(model.bufferViews[i], name)) {
        try {
          decodeView(model, model.bufferViews[i], *e, bytesLeft);
        } catch (const Error& error) {
          fail("buffer view {}: {}: {}", i, name, error.what());
        }
        break;
      }
}

}  // namespace ninefold
