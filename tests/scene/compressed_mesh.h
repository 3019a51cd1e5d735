// compressed_mesh.h: glTF files of one mesh, made in code: as it is, and compressed by the
// encoders of the libraries. Without GoogleTest, for fuzz targets too.
#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace ninefold {

struct PlainMesh {
  std::vector<float> positions, normals, uv;  // three, three and two for each vertex
  std::vector<uint32_t> indices;
  uint32_t vertices() const { return static_cast<uint32_t>(positions.size() / 3); }
};

// n x n squares of a wavy unit square; all normals differ.
inline PlainMesh wavyGrid(uint32_t n) {
  PlainMesh mesh;
  for (uint32_t y = 0; y <= n; ++y)
    for (uint32_t x = 0; x <= n; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(n),
                  v = static_cast<float>(y) / static_cast<float>(n);
      const float dx = 0.3f * std::cos(3 * u), dy = 0.2f * std::cos(2 * v);
      const float length = std::sqrt(1 + dx * dx + dy * dy);
      mesh.positions.insert(mesh.positions.end(),
                            {u, v, 0.1f * (std::sin(3 * u) + std::sin(2 * v))});
      mesh.normals.insert(mesh.normals.end(), {-dx / length, -dy / length, 1 / length});
      mesh.uv.insert(mesh.uv.end(), {u, 1 - v});
    }
  for (uint32_t y = 0; y < n; ++y)
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t a = y * (n + 1) + x, b = a + n + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  return mesh;
}

// The JSON of a file with one mesh, and the binary data behind it.
class OneMeshFile {
 public:
  std::string attributes, indices, primitive;  // members, each begins with a comma
  std::string required, buffers;               // quoted names; more buffers after the first
  std::vector<unsigned char> binary;

  // Appends data. Returns "buffer", "byteOffset" and "byteLength" of where they lie.
  std::string place(const void* data, size_t bytes) {
    binary.resize((binary.size() + 3) / 4 * 4);
    const size_t at = binary.size();
    binary.resize(at + bytes);
    if (bytes > 0) std::memcpy(binary.data() + at, data, bytes);
    return R"("buffer": 0, "byteOffset": )" + std::to_string(at) + R"(, "byteLength": )" +
           std::to_string(bytes);
  }
  // Text that names the new view or accessor: its number.
  std::string addView(const std::string& members) {
    views_ += (viewCount_ == 0 ? "{" : ", {") + members + "}";
    return std::to_string(viewCount_++);
  }
  std::string addAccessor(const std::string& view, size_t count, int componentType,
                          const std::string& type, const std::string& members = "") {
    accessors_ += (accessorCount_ == 0 ? "{" : ", {") +
                  (view.empty() ? "" : R"("bufferView": )" + view + ", ") + R"("count": )" +
                  std::to_string(count) + R"(, "componentType": )" + std::to_string(componentType) +
                  R"(, "type": ")" + type + "\"" + members + "}";
    return std::to_string(accessorCount_++);
  }
  std::string json(const std::string& uri = "") const {
    return R"({"asset": {"version": "2.0"}, "extensionsRequired": [)" + required +
           R"(], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0)" + node +
           R"(}], "meshes": [{"name": "grid", "primitives": [{"attributes": {)" + attributes + "}" +
           indices + primitive + R"(}]}], "accessors": [)" + accessors_ + R"(], "bufferViews": [)" +
           views_ + R"(], "buffers": [{"byteLength": )" + std::to_string(binary.size()) +
           (uri.empty() ? "" : R"(, "uri": ")" + uri + "\"") + "}" + buffers + "]}";
  }
  std::string node;  // members, begins with a comma

 private:
  std::string views_, accessors_;
  int viewCount_ = 0, accessorCount_ = 0;
};

inline constexpr int kFloatType = 5126, kWordType = 5125;

// `view(data, count, stride)` makes the view of an array and returns its number.
template <typename View>
OneMeshFile fileOf(const PlainMesh& mesh, const View& view) {
  OneMeshFile file;
  const uint32_t n = mesh.vertices();
  const auto add = [&](const std::vector<float>& values, const char* type, size_t components) {
    return file.addAccessor(view(file, values.data(), n, 4 * components), n, kFloatType, type);
  };
  file.attributes = R"("POSITION": )" + add(mesh.positions, "VEC3", 3);
  file.attributes += R"(, "NORMAL": )" + add(mesh.normals, "VEC3", 3);
  file.attributes += R"(, "TEXCOORD_0": )" + add(mesh.uv, "VEC2", 2);
  const std::string list = view(file, mesh.indices.data(), mesh.indices.size(), 4);
  file.indices =
      R"(, "indices": )" + file.addAccessor(list, mesh.indices.size(), kWordType, "SCALAR");
  return file;
}

inline OneMeshFile plainFile(const PlainMesh& mesh) {
  return fileOf(mesh, [](OneMeshFile& file, const void* data, size_t count, size_t stride) {
    return file.addView(file.place(data, count * stride));
  });
}

// meshoptimizer ---------------------------------------------------------------------------------

inline std::vector<unsigned char> encodeAttributes(const void* data, size_t count, size_t stride) {
  meshopt_encodeVertexVersion(0);
  std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
  out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), data, count, stride));
  return out;
}

inline std::vector<unsigned char> encodeTriangles(const std::vector<uint32_t>& indices,
                                                  size_t vertices) {
  std::vector<unsigned char> out(meshopt_encodeIndexBufferBound(indices.size(), vertices));
  out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), indices.size()));
  return out;
}

inline std::vector<unsigned char> encodeSequence(const std::vector<uint32_t>& indices,
                                                 size_t vertices) {
  std::vector<unsigned char> out(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
  out.resize(meshopt_encodeIndexSequence(out.data(), out.size(), indices.data(), indices.size()));
  return out;
}

// A view of compressed data. Its plain data would lie in the file's second buffer.
inline std::string addMeshoptView(OneMeshFile& file, const std::vector<unsigned char>& stream,
                                  size_t count, size_t stride, const std::string& mode,
                                  const std::string& filter = "",
                                  const std::string& name = "EXT_meshopt_compression") {
  const std::string place = file.place(stream.data(), stream.size());
  return file.addView(R"("buffer": 1, "byteLength": )" + std::to_string(count * stride) +
                      (mode == "ATTRIBUTES" ? R"(, "byteStride": )" + std::to_string(stride) : "") +
                      R"(, "extensions": {")" + name + R"(": {)" + place + R"(, "count": )" +
                      std::to_string(count) + R"(, "byteStride": )" + std::to_string(stride) +
                      R"(, "mode": ")" + mode + "\"" +
                      (filter.empty() ? "" : R"(, "filter": ")" + filter + "\"") + "}}");
}

inline void announceMeshopt(OneMeshFile& file,
                            const std::string& name = "EXT_meshopt_compression") {
  file.required = "\"" + name + "\"";
  file.buffers =
      R"(, {"byteLength": 1000000000, "extensions": {")" + name + R"(": {"fallback": true}}})";
}

inline OneMeshFile meshoptFile(const PlainMesh& mesh,
                               const std::string& name = "EXT_meshopt_compression") {
  OneMeshFile made =
      fileOf(mesh, [&](OneMeshFile& file, const void* data, size_t count, size_t stride) {
        if (data == mesh.indices.data())
          return addMeshoptView(file, encodeTriangles(mesh.indices, mesh.vertices()), count, stride,
                                "TRIANGLES", "", name);
        return addMeshoptView(file, encodeAttributes(data, count, stride), count, stride,
                              "ATTRIBUTES", "", name);
      });
  announceMeshopt(made, name);
  return made;
}

// Draco -----------------------------------------------------------------------------------------

inline constexpr int kDracoBits = 14;  // of positions, normals, coordinates

inline void addDracoAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type,
                              const std::vector<float>& values, uint32_t count) {
  const size_t components = values.size() / count;
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, static_cast<uint8_t>(components), draco::DT_FLOAT32, false,
                 static_cast<int64_t>(4 * components), 0);
  const int id = mesh.AddAttribute(attribute, true, count);
  for (uint32_t i = 0; i < count; ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                          values.data() + components * i);
}

// With `speed` 10 the sequential method, which keeps the vertices' order.
inline std::vector<unsigned char> encodeDraco(const PlainMesh& plain, int speed = 5) {
  draco::Mesh mesh;
  mesh.SetNumFaces(plain.indices.size() / 3);
  mesh.set_num_points(plain.vertices());
  for (uint32_t f = 0; f < mesh.num_faces(); ++f)
    mesh.SetFace(draco::FaceIndex(f), {draco::PointIndex(plain.indices[3 * f]),
                                       draco::PointIndex(plain.indices[3 * f + 1]),
                                       draco::PointIndex(plain.indices[3 * f + 2])});
  addDracoAttribute(mesh, draco::GeometryAttribute::POSITION, plain.positions, plain.vertices());
  addDracoAttribute(mesh, draco::GeometryAttribute::NORMAL, plain.normals, plain.vertices());
  addDracoAttribute(mesh, draco::GeometryAttribute::TEX_COORD, plain.uv, plain.vertices());
  draco::Encoder encoder;
  encoder.SetSpeedOptions(speed, speed);
  for (const auto type : {draco::GeometryAttribute::POSITION, draco::GeometryAttribute::NORMAL,
                          draco::GeometryAttribute::TEX_COORD})
    encoder.SetAttributeQuantization(type, kDracoBits);
  draco::EncoderBuffer out;
  if (!encoder.EncodeMeshToBuffer(mesh, &out).ok()) return {};
  return {out.data(), out.data() + out.size()};
}

// `vertices`, `indices`: what the accessors say that the stream holds.
inline OneMeshFile dracoFile(const std::vector<unsigned char>& stream, size_t vertices,
                             size_t indices) {
  OneMeshFile file;
  file.required = R"("KHR_draco_mesh_compression")";
  file.attributes = R"("POSITION": )" + file.addAccessor("", vertices, kFloatType, "VEC3");
  file.attributes += R"(, "NORMAL": )" + file.addAccessor("", vertices, kFloatType, "VEC3");
  file.attributes += R"(, "TEXCOORD_0": )" + file.addAccessor("", vertices, kFloatType, "VEC2");
  file.indices = R"(, "indices": )" + file.addAccessor("", indices, kWordType, "SCALAR");
  const std::string view = file.addView(file.place(stream.data(), stream.size()));
  file.primitive = R"(, "extensions": {"KHR_draco_mesh_compression": {"bufferView": )" + view +
                   R"(, "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}})";
  return file;
}

}  // namespace ninefold
