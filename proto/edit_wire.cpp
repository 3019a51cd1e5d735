#include "proto/edit_wire.h"

#include "proto/messages.h"

namespace ninefold {
namespace {

constexpr int kMotionNumbers = 12;

void toWire(Vec3 v, pb::Vec3& out) { out.set_x(v.x), out.set_y(v.y), out.set_z(v.z); }
Vec3 fromWire(const pb::Vec3& in) { return Vec3(in.x(), in.y(), in.z()); }

ObjectEdit fromWire(const pb::ObjectEdit& in) {
  if (in.motion_size() != kMotionNumbers)
    fail("a motion has {} numbers instead of {}", in.motion_size(), kMotionNumbers);
  if (in.node() > 0x7fffffff) fail("node {} is out of range", in.node());
  ObjectEdit edit;
  edit.node = static_cast<int>(in.node());
  for (int i = 0; i < kMotionNumbers; ++i) edit.motion[i / 3][i % 3] = in.motion(i);
  return edit;
}

std::vector<Vec3> vectors(ByteReader& bytes, size_t count) {
  std::vector<Vec3> all(bytes.count(count, sizeof(Vec3), "a shape"));
  bytes.raw(all.data(), all.size() * sizeof(Vec3), "a shape");
  return all;
}

ShapeEdit fromWire(const pb::ShapeEdit& in, ByteReader& bytes) {
  if (in.vertices() < 1 || in.vertices() > ShapePiece::kVertices)
    fail("a piece of a shape has {} vertices, must be 1 to {}", in.vertices(),
         ShapePiece::kVertices);
  ShapeVertices vertices;
  vertices.positions = vectors(bytes, in.vertices());
  if (in.normals()) vertices.normals = vectors(bytes, in.vertices());
  return {{in.mesh(), in.piece()}, std::make_shared<const ShapeVertices>(std::move(vertices))};
}

}  // namespace

Bytes shapeBytes(const std::vector<ShapeEdit>& shapes) {
  Bytes bytes;
  ByteWriter out(bytes);
  for (const ShapeEdit& shape : shapes)
    for (const auto* list : {&shape.vertices->positions, &shape.vertices->normals})
      out.raw(list->data(), list->size() * sizeof(Vec3));
  return bytes;
}

void toWire(const SceneEdit& edit, pb::Edit& out) {
  for (const ObjectEdit& e : edit.objects) {
    pb::ObjectEdit& object = *out.add_objects();
    object.set_node(static_cast<uint32_t>(e.node));
    for (int i = 0; i < kMotionNumbers; ++i) object.add_motion(e.motion[i / 3][i % 3]);
  }
  for (const LightEdit& e : edit.lights) {
    pb::LightEdit& light = *out.add_lights();
    light.set_light(e.light);
    toWire(e.position, *light.mutable_position());
    toWire(e.direction, *light.mutable_direction());
    toWire(e.intensity, *light.mutable_intensity());
    toWire(e.across, *light.mutable_across());
  }
  for (const MaterialEdit& e : edit.materials) {
    pb::MaterialEdit& material = *out.add_materials();
    material.set_material(e.material);
    toWire(e.baseColor, *material.mutable_base_color());
    material.set_metallic(e.metallic);
    material.set_roughness(e.roughness);
    material.set_transmission(e.transmission);
    material.set_ior(e.ior);
    toWire(e.emission, *material.mutable_emission());
  }
  for (const ShapeEdit& e : edit.shapes) {
    pb::ShapeEdit& shape = *out.add_shapes();
    shape.set_mesh(e.where.mesh);
    shape.set_piece(e.where.piece);
    shape.set_vertices(static_cast<uint32_t>(e.vertices->positions.size()));
    shape.set_normals(!e.vertices->normals.empty());
  }
}

SceneEdit fromWire(const pb::Edit& in, ByteView payload) {
  const int total = std::max({in.objects_size(), in.lights_size(), in.materials_size()});
  if (static_cast<size_t>(total) > kMaxEdits) fail("{} edits, at most {}", total, kMaxEdits);
  SceneEdit edit;
  for (const pb::ObjectEdit& e : in.objects()) edit.objects.push_back(fromWire(e));
  for (const pb::LightEdit& e : in.lights())
    edit.lights.push_back({e.light(), fromWire(e.position()), fromWire(e.direction()),
                           fromWire(e.intensity()), fromWire(e.across())});
  for (const pb::MaterialEdit& e : in.materials())
    edit.materials.push_back({e.material(), fromWire(e.base_color()), e.metallic(), e.roughness(),
                              e.transmission(), e.ior(), fromWire(e.emission())});
  if (static_cast<size_t>(in.shapes_size()) > kMaxShapePieces)
    fail("{} pieces of shapes, at most {}", in.shapes_size(), kMaxShapePieces);
  ByteReader bytes(payload, "shapes");
  for (const pb::ShapeEdit& e : in.shapes()) edit.shapes.push_back(fromWire(e, bytes));
  bytes.expectEnd();
  return edit;
}

}  // namespace ninefold
