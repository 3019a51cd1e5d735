#include "common/scene/emitters.h"

#include <array>
#include <bit>
#include <tuple>

#include "common/math/rounding.h"
#include "common/sampling/hash.h"
#include "common/sampling/warp.h"
#include "common/scene/emitter_power.h"
#include "common/scene/texture.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

// Share of the light of a textured emitter's texel that the surface's own opacity lets through.
float coverage(const Scene& scene, const Material& m, const TexturePlace& at) {
  if (m.alphaMode == AlphaMode::opaque) return 1.0f;
  float alpha = m.opacity * at.alpha;
  if (m.baseColorMap) alpha *= lookUp(scene, m.baseColorMap, at.uv0, at.uv1).w;
  if (m.alphaMode == AlphaMode::mask) return alpha < m.alphaCutoff ? 0.0f : 1.0f;
  return std::clamp(alpha, 0.0f, 1.0f);
}

EmitterKind kindOf(LightKind kind) {
  switch (kind) {
    case LightKind::point:
      return EmitterKind::point;
    case LightKind::spot:
      return EmitterKind::spot;
    case LightKind::goniometric:
      return EmitterKind::goniometric;
    case LightKind::directional:
      break;
  }
  return EmitterKind::directional;
}

Emitter triangleEmitter(const Mesh& mesh, const DMat4& toWorld, uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  Emitter e;
  e.kind = EmitterKind::triangle;
  e.triangle = triangle;
  e.a = worldPoint(toWorld, mesh.positions[t.x]);
  e.b = worldPoint(toWorld, mesh.positions[t.y]);
  e.c = worldPoint(toWorld, mesh.positions[t.z]);
  const DVec3 cross = exactNormal(e.a, e.b, e.c);
  const double length = glm::length(cross);
  e.area = static_cast<float>(0.5 * length);
  if (length > 0) e.normal = Vec3(cross / (mirrors(toWorld) ? -length : length));
  return e;
}

// Corners in an order that does not depend on where a mesh starts to count them. The front belongs
// to the place, unless both sides emit.
std::array<Vec3, 3> placeOf(const Emitter& e) {
  std::array<Vec3, 3> corners = {e.a, e.b, e.c};
  std::sort(corners.begin(), corners.end(),
            [](Vec3 p, Vec3 q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); });
  const Vec3 n = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (!e.doubleSided && glm::dot(n, e.normal) < 0) std::swap(corners[1], corners[2]);
  return corners;
}

bool isTwice(const Emitter& one, const Emitter& other) {
  return placeOf(one) == placeOf(other) && one.doubleSided == other.doubleSided &&
         one.flux == other.flux;
}

uint64_t hashOfPlace(const Emitter& e) {
  uint64_t hash = 0;
  for (const Vec3& p : placeOf(e))
    for (int c = 0; c < 3; ++c)
      hash = hashWords(hash, std::bit_cast<uint32_t>(p[c] + 0.0f));  // -0 is 0
  return hash;
}

bool sameObject(const Emitter& one, const Emitter& other) {
  return one.kind == EmitterKind::triangle && other.kind == EmitterKind::triangle &&
         one.instance == other.instance;
}

// Each object's share, dealt out to its emitters by power.
std::vector<float> choiceWeights(const std::vector<Emitter>& emitters,
                                 const std::vector<float>& power) {
  std::vector<double> ofObject;
  std::vector<size_t> objectOf;
  objectOf.reserve(emitters.size());
  for (size_t i = 0; i < emitters.size(); ++i) {
    if (i == 0 || !sameObject(emitters[i - 1], emitters[i])) ofObject.push_back(0);
    ofObject.back() += static_cast<double>(power[i]);
    objectOf.push_back(ofObject.size() - 1);
  }
  const std::vector<double> share = partlyAlike(ofObject);
  std::vector<float> weights;
  weights.reserve(emitters.size());
  for (size_t i = 0; i < emitters.size(); ++i) {
    const size_t object = objectOf[i];
    weights.push_back(
        static_cast<float>(static_cast<double>(power[i]) / ofObject[object] * share[object]));
  }
  return weights;
}

bool isPower(float power) { return power > 0 && std::isfinite(power); }

// Calls take(emitter, power) for each triangle of an instance that may shine, until it wants no
// more.
template <typename Take>
bool forEachTriangle(const Scene& scene, uint32_t instance, TriangleRadiance& radiance, Take take) {
  const Instance& i = scene.instances[instance];
  const Mesh& mesh = scene.meshes[static_cast<size_t>(i.mesh)];
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  if (isBlack(material.emission)) return true;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Emitter e = triangleEmitter(mesh, i.toWorld, t);
    const TriangleRadiance::Value L = radiance.of(mesh, t);
    const float measure = kPi * e.area * (material.doubleSided ? 2.0f : 1.0f);
    e.instance = instance, e.doubleSided = material.doubleSided, e.flux = measure * L.mean;
    if (!take(e, std::max(maxComponent(e.flux), measure * L.least))) return false;
  }
  return true;
}

}  // namespace

Radiance emittedRadiance(const Scene& scene, int material, const TexturePlace& at) {
  const Material& m = scene.materials[static_cast<size_t>(material)];
  if (isBlack(m.emission)) return Radiance(0);
  const Radiance L = coverage(scene, m, at) * m.emission;
  return m.emissionMap ? L * Vec3(lookUp(scene, m.emissionMap, at.uv0, at.uv1)) : L;
}

bool Emitters::anyIn(const Scene& scene) {
  const float R = scene.bounds.radius();
  std::vector<double> solidAngles;
  for (const LightProfile& profile : scene.profiles) solidAngles.push_back(solidAngleOf(profile));
  for (const PunctualLight& light : scene.lights)
    if (isPower(maxComponent(punctualFlux(light, R, solidAngles)))) return true;
  TriangleRadiance radiance(scene);
  const auto isDark = [](const Emitter&, float power) { return !isPower(power); };
  for (uint32_t i = 0; i < scene.instances.size(); ++i)
    if (!forEachTriangle(scene, i, radiance, isDark)) return true;
  return false;
}

Emitters::Emitters(const Scene& scene, Radiance environment)
    : scene_(&scene),
      profiles_(scene.profiles.begin(), scene.profiles.end()),
      environment_(environment),
      map_(scene.environmentMap.get()) {
  std::vector<float> power;
  TriangleRadiance radiance(scene);
  Places places;
  firstOfInstance_.reserve(scene.instances.size() + 1);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    firstOfInstance_.push_back(static_cast<uint32_t>(emitters_.size()));
    addTriangles(i, radiance, places, power);
  }
  firstOfInstance_.push_back(static_cast<uint32_t>(emitters_.size()));
  const float R = scene.bounds.radius();
  std::vector<double> solidAngles;
  for (const ProfileSampling& profile : profiles_) solidAngles.push_back(profile.solidAngle());
  for (uint32_t i = 0; i < scene.lights.size(); ++i) {
    Emitter e;
    e.kind = kindOf(scene.lights[i].kind), e.light = i;
    e.flux = punctualFlux(scene.lights[i], R, solidAngles);
    append(e, maxComponent(e.flux), power);
  }
  Emitter sky;
  sky.kind = EmitterKind::environment, sky.flux = 4 * kPi * kPi * R * R * environment;
  if (map_ != nullptr) sky.flux *= map_->mean();
  append(sky, maxComponent(sky.flux), power);
  byPower_ = Distribution(choiceWeights(emitters_, power));
}

void Emitters::addTriangles(uint32_t instance, TriangleRadiance& radiance, Places& places,
                            std::vector<float>& power) {
  forEachTriangle(*scene_, instance, radiance, [&](const Emitter& e, float itsPower) {
    const uint64_t place = hashOfPlace(e);
    const auto before = places.find(place);
    if (before != places.end() && isTwice(e, emitters_[before->second])) {
      doubles_[{instance, e.triangle}] = before->second;
    } else if (isPower(itsPower)) {
      append(e, itsPower, power);
      places.try_emplace(place, static_cast<uint32_t>(emitters_.size() - 1));
    }
    return true;
  });
}

void Emitters::append(const Emitter& emitter, float itsPower, std::vector<float>& power) {
  if (!isPower(itsPower)) return;
  emitters_.push_back(emitter);
  power.push_back(itsPower);
}

EmitterPoint Emitters::pointAt(uint32_t emitter, Vec2 b) const {
  const Emitter& e = emitters_[emitter];
  const Mesh& mesh = scene_->meshes[static_cast<size_t>(scene_->instances[e.instance].mesh)];
  EmitterPoint p;
  p.position = pointOnTriangle(e.a, e.b, e.c, b.x, b.y);
  p.radiance = radianceOf(mesh.material, placeAt(mesh, e.triangle, b));
  p.error = triangleError(e.a, e.b, e.c, e.normal, p.position);
  return p;
}

Vec3 Emitters::sampleEnvironment(Vec2 u) const {
  return map_ != nullptr ? map_->sample(u) : squareToSphere(u);
}

float Emitters::environmentPdf(Vec3 w) const { return map_ != nullptr ? map_->pdf(w) : kSpherePdf; }

int Emitters::find(uint32_t instance, uint32_t triangle) const {
  const auto first = emitters_.begin() + firstOfInstance_[instance];
  const auto last = emitters_.begin() + firstOfInstance_[instance + 1];
  const auto found = std::lower_bound(first, last, triangle,
                                      [](const Emitter& e, uint32_t t) { return e.triangle < t; });
  if (found != last && found->triangle == triangle)
    return static_cast<int>(found - emitters_.begin());
  const auto twice = doubles_.find({instance, triangle});
  return twice == doubles_.end() ? -1 : static_cast<int>(twice->second);
}

Intensity Emitters::intensity(const Scene& scene, const PunctualLight& light, Vec3 direction) {
  if (light.kind == LightKind::goniometric)
    return profileTowards(scene.profiles[static_cast<size_t>(light.profile)], light.direction,
                          light.across, direction) *
           light.intensity;
  if (light.kind != LightKind::spot) return light.intensity;
  const float outer = std::cos(light.outerCone);
  const float width = std::max(0.001f, std::cos(light.innerCone) - outer);
  const float t = std::clamp((glm::dot(direction, light.direction) - outer) / width, 0.0f, 1.0f);
  return t * t * light.intensity;
}

}  // namespace ninefold
