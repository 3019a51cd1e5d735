#include "common/scene/obj_reader.h"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/scene/mesh_cleanup.h"
#include "common/scene/obj_material.h"
#include "common/scene/obj_parser.h"
#include "common/scene/polygon.h"

namespace ninefold {
namespace {

struct CornerHash {
  size_t operator()(const ObjCorner& c) const {
    uint64_t hash = 0;
    for (const int i : {c.position, c.coordinate, c.normal})
      hash = (hash ^ static_cast<uint32_t>(i)) * 0x9E3779B97F4A7C15ull;
    return static_cast<size_t>(hash ^ hash >> 32);
  }
};

// Where a corner without texture coordinates looks a texture up: (0, 0) of the file.
constexpr Vec2 kNoCoordinate{0, 1};

bool isMapped(const Material& m) {
  return std::ranges::any_of(mapsOf(m), [](const TextureUse* use) { return bool(*use); });
}

// Takes the parser's events. Each group of faces makes one mesh for every material in it.
class ObjBuilder : public ObjEvents {
 public:
  explicit ObjBuilder(const SceneFolder& folder) : materials_(folder, draft_.scene) {}
  SceneDraft build(std::string_view text);

  void addLibraries(std::string_view line) override { materials_.addLibraries(line); }
  void addPosition(DVec3 position) override { positions_.push_back(position); }
  void colourPosition(Vec3 srgb) override;
  void addCoordinate(Vec2 uv) override { coordinates_.emplace_back(uv.x, 1 - uv.y); }
  void addNormal(Vec3 normal) override { normals_.push_back(normal); }
  void addFace(std::span<const ObjCorner> corners) override;
  void startGroup(std::string name) override;
  void useMaterial(std::string name) override { material_ = std::move(name); }

 private:
  struct Part {
    Mesh mesh;
    std::unordered_map<ObjCorner, uint32_t, CornerHash> vertices;
    bool hasNormals = false;
    size_t facesWithoutCoordinates = 0;
  };
  void finishGroup();
  void finishPart(const std::string& material, Part& part);
  void giveMaterials();
  uint32_t vertex(Part& part, const ObjCorner& corner) const;
  Vec3 positionOf(const ObjCorner& corner) const {
    return Vec3(positions_[static_cast<size_t>(corner.position)] - *origin_);
  }

  SceneDraft draft_;
  ObjMaterials materials_;
  std::vector<DVec3> positions_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> coordinates_;
  std::vector<Vec3> colours_;    // linear, of the positions up to the last one that has one
  std::optional<DVec3> origin_;  // of the meshes' coordinates: the first corner of all
  std::string group_, material_;
  std::map<std::string, Part> parts_;  // of the group, by material
  struct Use {
    std::string material;
    size_t facesWithoutCoordinates;
  };
  std::vector<Use> uses_;  // one per mesh
  int groups_ = 0;
  size_t flatTriangles_ = 0;
  std::vector<uint32_t> vertices_;  // of the face at hand
  std::vector<Vec3> corners_;
};

SceneDraft ObjBuilder::build(std::string_view text) {
  parseObj(text, *this);
  finishGroup();
  giveMaterials();
  if (flatTriangles_ > 0) warn("{} triangles without area are left out", flatTriangles_);
  return std::move(draft_);
}

void ObjBuilder::startGroup(std::string name) {
  finishGroup();
  group_ = std::move(name);
}

void ObjBuilder::finishGroup() {
  for (auto& [material, part] : parts_) finishPart(material, part);
  groups_ += parts_.empty() ? 0 : 1;
  parts_.clear();
}

void ObjBuilder::finishPart(const std::string& material, Part& part) {
  Mesh& mesh = part.mesh;
  if (!part.hasNormals) mesh.normals.clear();
  flatTriangles_ += cleanMesh(mesh, "group '" + group_ + "'");
  if (mesh.triangles.empty()) return;
  mesh.name = group_;
  draft_.scene.meshes.push_back(std::move(mesh));
  uses_.push_back({material, part.facesWithoutCoordinates});
  DMat4 toWorld(1);
  toWorld[3] = DVec4(*origin_, 1);
  draft_.addInstance(static_cast<int>(draft_.scene.meshes.size()) - 1, groups_, group_, toWorld);
}

// Last of all, because mtllib may stand anywhere.
void ObjBuilder::giveMaterials() {
  size_t unmapped = 0;
  for (size_t i = 0; i < uses_.size(); ++i) {
    Mesh& mesh = draft_.scene.meshes[i];
    mesh.material = materials_.use(uses_[i].material, !mesh.colors.empty());
    const bool mapped = isMapped(draft_.scene.materials[static_cast<size_t>(mesh.material)]);
    if (mapped) unmapped += uses_[i].facesWithoutCoordinates;
    const auto absent = [](Vec2 uv) { return uv == kNoCoordinate; };
    if (!mapped && std::all_of(mesh.uv0.begin(), mesh.uv0.end(), absent)) mesh.uv0.clear();
  }
  if (unmapped > 0)
    warn(
        "{} faces have a texture but no texture coordinates: all of each shows the texture's "
        "corner (0, 0); unwrap them",
        unmapped);
}

// Colours are as a screen shows them. IEC 61966-2-1.
void ObjBuilder::colourPosition(Vec3 srgb) {
  const auto linear = [](float c) {
    c = std::clamp(c, 0.0f, 1.0f);
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
  };
  colours_.resize(positions_.size(), Vec3(1));
  colours_.back() = Vec3(linear(srgb.x), linear(srgb.y), linear(srgb.z));
}

// An absent normal is 0 for now: cleanMesh makes it the faces' own.
uint32_t ObjBuilder::vertex(Part& part, const ObjCorner& corner) const {
  Mesh& mesh = part.mesh;
  const auto [entry, isNew] =
      part.vertices.try_emplace(corner, static_cast<uint32_t>(mesh.positions.size()));
  if (!isNew) return entry->second;
  const auto [position, coordinate, normal] = corner;
  const auto place = static_cast<size_t>(position);
  const bool coloured = place < colours_.size();
  mesh.positions.push_back(positionOf(corner));
  mesh.uv0.push_back(coordinate < 0 ? kNoCoordinate
                                    : coordinates_[static_cast<size_t>(coordinate)]);
  mesh.normals.push_back(normal < 0 ? Vec3(0) : normals_[static_cast<size_t>(normal)]);
  if (coloured) mesh.colors.resize(mesh.positions.size() - 1, Vec4(1));
  if (coloured || !mesh.colors.empty())
    mesh.colors.emplace_back(coloured ? colours_[place] : Vec3(1), 1);
  part.hasNormals |= normal >= 0;
  return entry->second;
}

void ObjBuilder::addFace(std::span<const ObjCorner> corners) {
  Part& part = parts_[material_];
  vertices_.clear(), corners_.clear();
  bool mapped = true;
  for (const ObjCorner& corner : corners) {
    if (!origin_) origin_ = positions_[static_cast<size_t>(corner.position)];
    vertices_.push_back(vertex(part, corner));
    corners_.push_back(positionOf(corner));
    mapped &= corner.coordinate >= 0;
  }
  part.facesWithoutCoordinates += mapped ? 0 : 1;
  for (const Triangle& t : triangulate(corners_))
    part.mesh.triangles.emplace_back(vertices_[t.x], vertices_[t.y], vertices_[t.z]);
}

}  // namespace

SceneDraft readObj(std::span<const unsigned char> file, const SceneFolder& folder) {
  return ObjBuilder(folder).build({reinterpret_cast<const char*>(file.data()), file.size()});
}

}  // namespace ninefold
