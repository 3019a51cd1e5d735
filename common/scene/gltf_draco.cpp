#include "common/scene/gltf_draco.h"

#include <draco/mesh/mesh.h>

#include <cstring>

#include "common/scene/draco_mesh.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_value.h"
#include "common/scene/reader.h"

namespace ninefold {
namespace {

int componentTypeOf(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return TINYGLTF_COMPONENT_TYPE_BYTE;
    case draco::DT_UINT8:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    case draco::DT_INT16:
      return TINYGLTF_COMPONENT_TYPE_SHORT;
    case draco::DT_UINT16:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    case draco::DT_UINT32:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    case draco::DT_FLOAT32:
      return TINYGLTF_COMPONENT_TYPE_FLOAT;
    default:
      fail("Draco's data type {} is not one of glTF", static_cast<int>(type));
  }
}

// The new accessor of `count` elements that lie packed in `data`. glTF's types of one to four
// components: SCALAR is by itself, VEC2 to VEC4 are the numbers 2 to 4.
int addAccessor(tinygltf::Model& model, std::vector<unsigned char> data, size_t count,
                int componentType, int components, bool normalized) {
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(model.buffers.size()), view.byteLength = data.size();
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.count = count, accessor.componentType = componentType, accessor.normalized = normalized;
  accessor.type = components == 1 ? TINYGLTF_TYPE_SCALAR : components;
  model.buffers.emplace_back().data = std::move(data);
  model.bufferViews.push_back(std::move(view));
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

int addIndices(tinygltf::Model& model, const draco::Mesh& mesh) {
  const size_t corners = size_t{3} * mesh.num_faces();
  std::vector<unsigned char> data(4 * corners);
  for (size_t i = 0; i < corners; ++i) {
    const uint32_t point = mesh.face(draco::FaceIndex(uint32_t(i / 3)))[i % 3].value();
    std::memcpy(data.data() + 4 * i, &point, sizeof point);
  }
  return addAccessor(model, std::move(data), corners, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, 1,
                     false);
}

// The attribute's value at each point of the mesh.
std::vector<unsigned char> valuesOf(const draco::PointAttribute& attribute, size_t points) {
  const size_t size = static_cast<size_t>(draco::DataTypeLength(attribute.data_type())) *
                      static_cast<size_t>(attribute.num_components());
  const size_t held = attribute.buffer()->data_size() / size;
  if (!attribute.is_mapping_identity() && attribute.indices_map_size() < points)
    fail("an attribute has fewer points than the mesh: damaged, export anew");
  std::vector<unsigned char> data(size * points);
  for (size_t i = 0; i < points; ++i) {
    const uint32_t value = attribute.mapped_index(draco::PointIndex(uint32_t(i))).value();
    if (value >= held) fail("point {} has no value: damaged, export anew", i);
    std::memcpy(data.data() + size * i, attribute.buffer()->data() + size * value, size);
  }
  return data;
}

int addAttribute(tinygltf::Model& model, const draco::Mesh& mesh, int id, int declared) {
  const draco::PointAttribute* attribute =
      id < 0 ? nullptr : mesh.GetAttributeByUniqueId(static_cast<uint32_t>(id));
  if (attribute == nullptr) fail("attribute {} is not in the Draco data", id);
  if (declared < 0 || static_cast<size_t>(declared) >= model.accessors.size())
    fail("accessor {} does not exist", declared);
  const bool normalized =
      attribute->normalized() || model.accessors[static_cast<size_t>(declared)].normalized;
  const int type = componentTypeOf(attribute->data_type());
  return addAccessor(model, valuesOf(*attribute, mesh.num_points()), mesh.num_points(), type,
                     attribute->num_components(), normalized);
}

void decodePrimitive(tinygltf::Model& model, tinygltf::Primitive& primitive,
                     const tinygltf::Value& e, DracoBudget& budget) {
  const BytesOfView bytes = bytesOfView(model, integerOr(e, "bufferView", -1), "its data");
  const auto mesh = decodeDracoMesh({bytes.data, bytes.size}, budget);
  if (!e.Has("attributes") || !e.Get("attributes").IsObject()) fail("'attributes' is missing");
  const tinygltf::Value& ids = e.Get("attributes");
  for (auto& [name, accessor] : primitive.attributes)
    if (ids.Has(name))
      accessor = addAttribute(model, *mesh, integerOr(ids, name.c_str(), -1), accessor);
  primitive.indices = addIndices(model, *mesh);
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

}  // namespace

void decodeDraco(tinygltf::Model& model) {
  DracoBudget budget{kMaxTriangles, kMaxFileBytes};
  for (size_t m = 0; m < model.meshes.size(); ++m)
    for (size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
      tinygltf::Primitive& primitive = model.meshes[m].primitives[p];
      const auto* e = extensionOf(primitive, kDracoExtension);
      if (e == nullptr) continue;
      try {
        decodePrimitive(model, primitive, *e, budget);
      } catch (const Error& error) {
        fail("mesh {} '{}' primitive {}: {}: {}", m, model.meshes[m].name, p, kDracoExtension,
             error.what());
      }
    }
}

}  // namespace ninefold
