// scene.h: a scene as plain data, as the readers make it, the wire carries it and the tracer eats
// it.
//
// Coordinates: right-handed, y up, metres. Readers move the middle of the scene's bounds to the
// origin (`origin` keeps what was subtracted), where float precision is best. Every Scene that left
// a reader or the wire is valid: finite numbers, indices in range, unit directions, at least one
// triangle.
//
// Owner: value type; copies share images and meshes.   Threads: plain data, shared read-only.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/shared_list.h"
#include "common/math/bounds.h"
#include "common/math/camera.h"
#include "common/math/units.h"
#include "common/scene/animated_node.h"
#include "common/scene/cover.h"
#include "common/scene/deformation.h"
#include "common/scene/environment_map.h"
#include "common/scene/light_profile.h"

namespace ninefold {

// Smallest and largest value of a channel of an image's texels.
struct ChannelRange {
  uint8_t low = 255, high = 0;
};
using TexelRanges = std::array<ChannelRange, 4>;

// 8-bit texels, rows top to bottom. srgb: R, G, B decode by the sRGB curve, A stays linear.
struct TextureImage {
  std::string name;
  int width = 0, height = 0, channels = 4;  // channels 1..4
  bool srgb = false;
  std::vector<uint8_t> texels;             // width * height * channels
  std::optional<TexelRanges> ranges = {};  // of a finished scene, see texel_ranges.h
};

enum class Wrap : uint8_t { repeat, clamp, mirror };

// Use of an image by a material: image index, texture coordinates and how to look up.
struct TextureUse {
  int image = -1;  // index into Scene::images; -1 = none
  int uvSet = 0;   // 0 or 1
  Vec2 offset{0, 0}, scale{1, 1};
  float rotation = 0;  // [rad], as in KHR_texture_transform
  Wrap wrapS = Wrap::repeat, wrapT = Wrap::repeat;
  bool nearest = false;  // else bilinear
  explicit operator bool() const { return image >= 0; }
};

enum class AlphaMode : uint8_t { opaque, mask, blend };

// glTF's metallic-roughness model with the extensions that matter for light transport.
// A factor multiplies its map. OBJ materials are translated to it.
struct Material {
  std::string name;
  Vec3 baseColor{1};
  TextureUse baseColorMap;  // sRGB, alpha = opacity
  float opacity = 1;
  AlphaMode alphaMode = AlphaMode::opaque;
  float alphaCutoff = 0.5f;
  float metallic = 1, roughness = 1;  // perceptual roughness; GGX alpha = roughness^2
  TextureUse metallicRoughnessMap;    // G = roughness, B = metallic
  TextureUse normalMap;
  float normalScale = 1;
  Vec3 emission{0};          // radiance [W/(m^2 sr)], strength included
  TextureUse emissionMap;    // sRGB
  bool doubleSided = false;  // of emission only: surfaces scatter on both sides
  float transmission = 0;
  TextureUse transmissionMap;  // R
  float ior = 1.5f;            // index of refraction, > 0
  float specular = 1;          // KHR_materials_specular
  TextureUse specularMap;      // A
  Vec3 specularColor{1};
  TextureUse specularColorMap;  // sRGB
  bool solid = false;           // transmits as a solid (refracts, attenuates); else thin-walled
  Vec3 attenuationColor{1};
  float attenuationDistance = std::numeric_limits<float>::infinity();  // [m]
  // Layers over it, where it does not transmit: KHR_materials_sheen, and a coat over all.
  Vec3 sheenColor{0};
  TextureUse sheenColorMap;  // sRGB
  float sheenRoughness = 0;
  TextureUse sheenRoughnessMap;  // A
  float coat = 0;                // KHR_materials_clearcoat
  TextureUse coatMap;            // R
  float coatRoughness = 0;
  TextureUse coatRoughnessMap;  // G
};

// All maps of a material, const or not.
template <typename M>
auto mapsOf(M& m) {
  return std::array{&m.baseColorMap,     &m.metallicRoughnessMap, &m.normalMap,
                    &m.emissionMap,      &m.transmissionMap,      &m.specularMap,
                    &m.specularColorMap, &m.sheenColorMap,        &m.sheenRoughnessMap,
                    &m.coatMap,          &m.coatRoughnessMap};
}

// Whether light passes through: metals do not transmit.
inline bool transmits(const Material& m) { return m.transmission > 0 && m.metallic < 1; }

inline bool hasCoat(const Material& m) { return m.coat > 0 && !transmits(m); }
inline bool hasSheen(const Material& m) { return !isBlack(m.sheenColor) && !transmits(m); }

struct Mesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;   // empty (flat shading) or one per vertex, unit
  std::vector<Vec2> uv0, uv1;  // empty or one per vertex
  std::vector<Vec4> tangents;  // empty or one per vertex, w = sign of the bitangent
  std::vector<Vec4> colors;  // empty or one per vertex, linear, in [0, 1]: times colour and opacity
  std::vector<Triangle> triangles;
  int material = 0;
  uint64_t shape = 0;  // 0 as read; else a number of the shape that an edit gave it
};

// Colour at barycentrics (u, v) of a triangle; exact where its corners have the same.
inline Vec4 colorAt(const Mesh& mesh, const Triangle& t, float u, float v) {
  if (mesh.colors.empty()) return Vec4(1);
  const Vec4 first = mesh.colors[t.x];
  const Vec4 color = first + u * (mesh.colors[t.y] - first) + v * (mesh.colors[t.z] - first);
  return glm::clamp(color, 0.0f, 1.0f);
}

struct Instance {
  std::string name;
  int mesh = 0;
  int node = 0;      // instances that came from one node of the file share it: one thing to a user
  DMat4 toWorld{1};  // affine, invertible, may mirror
};

enum class LightKind : uint8_t { point, spot, directional, goniometric };

// Punctual lights: no surface, so nothing ever hits them. light_units.h tells what candela and lux
// of files become.
struct PunctualLight {
  std::string name;
  LightKind kind = LightKind::point;
  Vec3 position{0};          // [m]
  Vec3 direction{0, 0, -1};  // unit, where the light goes
  Vec3 intensity{1};         // I where it is largest [W/sr]; directional: E0 [W/m^2]
  float innerCone = 0, outerCone = 0.7853982f;  // half angles [rad], 0 <= inner <= outer <= pi/2
  Vec3 across{1, 0, 0};  // goniometric: unit, perpendicular to direction, see light_profile.h
  int profile = -1;      // goniometric: index into Scene::profiles
};

struct Scene {
  std::string name;
  SharedList<TextureImage> images;
  std::vector<Material> materials;
  SharedList<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Instance> photonInstances;  // what photons of a pool meet, see photon_scene.h
  std::vector<PunctualLight> lights;
  SharedList<LightProfile> profiles;
  std::vector<Camera> cameras;  // at least one after reading
  // What an animation moves and deforms, see animation.h; the wire does not carry them.
  SharedList<AnimatedNode> animated;
  SharedList<AnimatedShape> shapes;
  SharedList<Skin> skins;
  std::string unplayable;   // an object whose movement cannot be played
  Radiance environment{0};  // from outside; times the map's values, if there is one
  std::shared_ptr<const EnvironmentMap> environmentMap;  // null: the same from all directions
  std::optional<float> exposure;  // [EV] that it is meant to be shown with; not on the wire
  DVec3 origin{0};                // file coordinates = scene coordinates + origin
  Bounds bounds;                  // of all instances as read, in scene coordinates
  Cover cover;                    // of what edits led out of them; not on the wire
};

}  // namespace ninefold
