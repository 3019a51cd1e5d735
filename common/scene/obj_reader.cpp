#include "common/scene/obj_reader.h"

#include <tiny_obj_loader.h>

#include <array>
#include <istream>
#include <map>
#include <optional>
#include <streambuf>
#include <unordered_map>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/scene/mesh_cleanup.h"
#include "common/scene/obj_guard.h"
#include "common/scene/obj_material.h"
#include "common/scene/polygon.h"

namespace ninefold {
namespace {

// Places of a corner's position, texture coordinate and normal; -1 = absent.
using Corner = std::array<int, 3>;

struct CornerHash {
  size_t operator()(const Corner& c) const {
    uint64_t hash = 0;
    for (const int i : c) hash = (hash ^ static_cast<uint32_t>(i)) * 0x9E3779B97F4A7C15ull;
    return static_cast<size_t>(hash ^ hash >> 32);
  }
};

std::string trimmed(std::string text) {
  text.erase(text.find_last_not_of(" \t\r") + 1);
  return text;
}

// The parser wants a stream: this one reads from where the bytes are.
class MemoryStream : private std::streambuf, public std::istream {
 public:
  explicit MemoryStream(std::string_view text) : std::istream(static_cast<std::streambuf*>(this)) {
    char* begin = const_cast<char*>(text.data());  // only ever read
    setg(begin, begin, begin + text.size());
  }
};

// Takes the parser's events. Each group of faces makes one mesh for every material in it.
class ObjBuilder {
 public:
  explicit ObjBuilder(const SceneFolder& folder) : materials_(folder, draft_.scene) {}

  SceneDraft build(std::span<const unsigned char> file);

 private:
  struct Part {
    Mesh mesh;
    std::unordered_map<Corner, uint32_t, CornerHash> vertices;
    bool hasNormals = false, hasCoordinates = false;
  };
  static tinyobj::callback_t callbacks();
  void startGroup(std::string name);
  void finishGroup();
  void addFace(std::span<const tinyobj::index_t> indices);
  uint32_t vertex(Part& part, const Corner& corner) const;
  Vec3 positionOf(int position) const;
  Corner cornerOf(const tinyobj::index_t& index) const;

  SceneDraft draft_;
  ObjMaterials materials_;
  std::vector<DVec3> positions_;  // of the whole file
  size_t positionsSoFar_ = 0;     // defined before the line that is read
  std::optional<DVec3> origin_;   // of the meshes' coordinates: the first corner of all
  std::vector<Vec3> normals_;
  std::vector<Vec2> coordinates_;
  std::string group_, material_;
  std::map<std::string, Part> parts_;  // of the group, by material
  int groups_ = 0;
  size_t flatTriangles_ = 0;
};

// 1-based, or counted back from the end; 0 is absent. The guard has seen to it that it is in range.
int place(int index, size_t count) {
  const int n = static_cast<int>(count);
  const int at = index > 0 ? index - 1 : n + index;
  if (index == 0) return -1;
  if (at < 0 || at >= n) fail("index {} is out of range, there are {}", index, n);
  return at;
}

tinyobj::callback_t ObjBuilder::callbacks() {
  tinyobj::callback_t c;
  c.vertex_cb = [](void* user, float, float, float, float) {
    ++static_cast<ObjBuilder*>(user)->positionsSoFar_;
  };
  c.normal_cb = [](void* user, float x, float y, float z) {
    static_cast<ObjBuilder*>(user)->normals_.emplace_back(x, y, z);
  };
  c.texcoord_cb = [](void* user, float u, float v, float) {
    static_cast<ObjBuilder*>(user)->coordinates_.emplace_back(u, 1 - v);
  };
  c.index_cb = [](void* user, tinyobj::index_t* indices, int count) {
    static_cast<ObjBuilder*>(user)->addFace({indices, static_cast<size_t>(count)});
  };
  c.usemtl_cb = [](void* user, const char* name, int) {
    static_cast<ObjBuilder*>(user)->material_ = trimmed(name);
  };
  c.group_cb = [](void* user, const char** names, int count) {
    std::string name;
    for (int i = 0; i < count; ++i) name += (i > 0 ? " " : "") + std::string(names[i]);
    static_cast<ObjBuilder*>(user)->startGroup(std::move(name));
  };
  c.object_cb = [](void* user, const char* name) {
    static_cast<ObjBuilder*>(user)->startGroup(trimmed(name));
  };
  return c;
}

SceneDraft ObjBuilder::build(std::span<const unsigned char> file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  ObjOutline outline = checkObj(text);
  for (const std::string& library : outline.libraries) materials_.addLibrary(library);
  positions_ = std::move(outline.positions);
  MemoryStream stream(text);
  std::string warnings, errors;
  if (!tinyobj::LoadObjWithCallback(stream, callbacks(), this, nullptr, &warnings, &errors))
    fail("damaged OBJ file: {}", errors.substr(0, errors.find('\n')));
  if (positionsSoFar_ != positions_.size())
    fail("damaged OBJ file: {} lines of positions, {} of them readable", positions_.size(),
         positionsSoFar_);
  finishGroup();
  if (flatTriangles_ > 0) warn("{} triangles without area are left out", flatTriangles_);
  return std::move(draft_);
}

void ObjBuilder::startGroup(std::string name) {
  finishGroup();
  group_ = std::move(name);
}

void ObjBuilder::finishGroup() {
  for (auto& [material, part] : parts_) {
    if (!part.hasNormals) part.mesh.normals.clear();
    if (!part.hasCoordinates) part.mesh.uv0.clear();
    flatTriangles_ += cleanMesh(part.mesh, "group '" + group_ + "'");
    if (part.mesh.triangles.empty()) continue;
    part.mesh.name = group_;
    part.mesh.material = materials_.use(material);
    draft_.scene.meshes.push_back(std::move(part.mesh));
    DMat4 toWorld(1);
    toWorld[3] = DVec4(*origin_, 1);
    draft_.addInstance(static_cast<int>(draft_.scene.meshes.size()) - 1, groups_, group_, toWorld);
  }
  groups_ += parts_.empty() ? 0 : 1;
  parts_.clear();
}

Corner ObjBuilder::cornerOf(const tinyobj::index_t& index) const {
  const int position = place(index.vertex_index, std::min(positionsSoFar_, positions_.size()));
  if (position < 0) fail("a face has a corner without a position");
  return {position, place(index.texcoord_index, coordinates_.size()),
          place(index.normal_index, normals_.size())};
}

Vec3 ObjBuilder::positionOf(int position) const {
  return Vec3(positions_[static_cast<size_t>(position)] - *origin_);
}

// An absent normal is 0 for now: cleanMesh makes it the faces' own.
uint32_t ObjBuilder::vertex(Part& part, const Corner& corner) const {
  Mesh& mesh = part.mesh;
  const auto [entry, isNew] =
      part.vertices.try_emplace(corner, static_cast<uint32_t>(mesh.positions.size()));
  if (!isNew) return entry->second;
  const auto [position, coordinate, normal] = corner;
  mesh.positions.push_back(positionOf(position));
  mesh.uv0.push_back(coordinate < 0 ? Vec2(0) : coordinates_[static_cast<size_t>(coordinate)]);
  mesh.normals.push_back(normal < 0 ? Vec3(0) : normals_[static_cast<size_t>(normal)]);
  part.hasCoordinates |= coordinate >= 0;
  part.hasNormals |= normal >= 0;
  return entry->second;
}

void ObjBuilder::addFace(std::span<const tinyobj::index_t> indices) {
  if (indices.size() < 3) return;
  Part& part = parts_[material_];
  std::vector<uint32_t> vertices;
  std::vector<Vec3> corners;
  for (const tinyobj::index_t& index : indices) {
    const Corner corner = cornerOf(index);
    if (!origin_) origin_ = positions_[static_cast<size_t>(corner[0])];
    vertices.push_back(vertex(part, corner));
    corners.push_back(positionOf(corner[0]));
  }
  for (const Triangle& t : triangulate(corners))
    part.mesh.triangles.emplace_back(vertices[t.x], vertices[t.y], vertices[t.z]);
}

}  // namespace

SceneDraft readObj(std::span<const unsigned char> file, const SceneFolder& folder) {
  return ObjBuilder(folder).build(file);
}

}  // namespace ninefold
