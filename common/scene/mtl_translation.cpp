#include "common/scene/mtl_translation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ninefold {
namespace {

constexpr float kGrey = 0.6f;
constexpr float kAny = std::numeric_limits<float>::max();

// Not-a-number becomes 0.
float clamped(float v, float high = 1) { return v > 0 ? std::min(v, high) : 0.0f; }
Vec3 clamped(Vec3 v, float high = 1) {
  return Vec3(clamped(v.x, high), clamped(v.y, high), clamped(v.z, high));
}

float mean(Vec3 v) { return (v.x + v.y + v.z) / 3; }

// What the material says, with what is absent filled in.
struct Reading {
  explicit Reading(const MtlMaterial& from);
  bool lightPasses() const { return from.Tf && maxComponent(Tf) > 0; }
  bool isGlass() const;
  bool reflects() const;
  float indexAbove1(float largest) const;

  const MtlMaterial& from;
  int illum;
  Vec3 Kd, Ks, Tf;
  bool isDark;  // Kd is black
  bool opacityIsGiven;
  float opacity;
};

float opacityOf(const MtlMaterial& from) {
  if (from.d) return clamped(*from.d);
  return from.Tr && *from.Tr < 1 ? 1 - clamped(*from.Tr) : 1.0f;
}

// A colour whose absence, or blackness under a map, means white.
Vec3 colourUnder(const MtlMap& map, const std::optional<Vec3>& colour, float high = 1) {
  const Vec3 c = clamped(colour.value_or(Vec3(0)), high);
  return map && isBlack(c) ? Vec3(1) : c;
}

bool saysNothing(const MtlMaterial& from) {
  return !from.Kd && !from.Ks && !from.Ke && !from.Tf && !from.mapKd && !from.mapKs && !from.mapKe;
}

Reading::Reading(const MtlMaterial& m) : from(m) {
  constexpr float kBlack = 0.02f;
  illum = static_cast<int>(std::clamp(m.illum.value_or(2.0f), -1.0f, 11.0f));
  Kd = saysNothing(m) ? Vec3(kGrey) : colourUnder(m.mapKd, m.Kd);
  Ks = colourUnder(m.mapKs, m.Ks);
  Tf = clamped(m.Tf.value_or(Vec3(0)), kAny);
  isDark = !m.mapKd && maxComponent(Kd) <= kBlack;
  opacity = opacityOf(m);
  if (opacity == 0 && m.mapD) opacity = 1;
  opacityIsGiven = m.d.has_value() || (m.Tr && *m.Tr < 1);
}

bool Reading::isGlass() const {
  const bool refracts = illum == 6 || illum == 7;
  if (!refracts && illum != 4 && illum != 9) return false;
  if (opacity < 1) return lightPasses() || opacity == 0;
  const bool bends = from.Ni.value_or(1) > 1;
  if (!refracts) return lightPasses() && isDark && bends && !opacityIsGiven;
  if (lightPasses()) return !opacityIsGiven || isDark;
  return !from.Tf && isDark && bends && !opacityIsGiven;
}

bool Reading::reflects() const {
  return illum == 3 || illum == 5 || illum == 8 || (illum == 6 && opacity < 1);
}

float Reading::indexAbove1(float largest) const {
  const float Ni = from.Ni.value_or(0);
  return Ni > 1 ? std::min(Ni, largest) : 1.5f;
}

Vec3 hue(Vec3 colour) { return isBlack(colour) ? Vec3(1) : colour / maxComponent(colour); }

void makeGlass(const Reading& r, Material& m) {
  m.baseColor = hue(r.Tf) * (r.isDark ? Vec3(1) : r.Kd);
  m.roughness = 0;
  m.transmission = 1;
  m.solid = true;
  m.ior = r.indexAbove1(100);
}

// F0 = ((n - 1) / (n + 1))^2.
void reflectAtNormalIncidence(Vec3 F0, Material& m) {
  const float root = std::sqrt(std::min(maxComponent(F0), 0.9995f));
  m.ior = (1 + root) / (1 - root);
  m.specular = 1;
  m.specularColor = hue(F0);
}

void makeGloss(const Reading& r, Vec3 Ks, Material& m) {
  const float Ns = clamped(r.from.Ns.value_or(1), 1e6f);
  m.baseColor = r.Kd;
  m.ior = r.indexAbove1(3);
  m.specular = std::min(1.0f, 2 * maxComponent(Ks));
  m.specularColor = hue(Ks);
  m.roughness = std::sqrt(std::sqrt(2 / (Ns + 2)));  // its square is GGX alpha
}

void makeReflecting(const Reading& r, Material& m) {
  const float ks = maxComponent(r.Ks);
  const bool mirror = ks > maxComponent(r.Kd) && (ks > 0.5f || r.isDark);
  makeGloss(r, r.Ks, m);
  m.roughness = 1 - std::sqrt(clamped(r.from.Ns.value_or(mirror ? 1000.0f : 1.0f), 1000) / 1000);
  if (mirror && !r.isDark) return reflectAtNormalIncidence(r.Ks, m);
  if (mirror) m.baseColor = r.Ks;
  m.metallic = r.from.Ka && !mirror ? clamped(mean(*r.from.Ka)) : 1.0f;
}

void makePhysical(const Reading& r, Material& m) {
  const MtlMaterial& from = r.from;
  makeGloss(r, from.Ks || from.mapKs ? r.Ks : Vec3(0.5f), m);
  m.metallic = clamped(from.Pm.value_or(from.mapPm ? 1.0f : 0.0f));
  if (from.Pr || from.mapPr) m.roughness = clamped(from.Pr.value_or(1));
  m.transmission = clamped(mean(r.Tf));
  m.solid = m.transmission > 0;
}

void addLayers(const MtlMaterial& from, Material& m) {
  constexpr float kSheenRoughness = 0.5f;
  m.sheenColor = Vec3(clamped(from.Ps.value_or(0)));
  if (!isBlack(m.sheenColor)) m.sheenRoughness = kSheenRoughness;
  m.coat = clamped(from.Pc.value_or(0));
  if (m.coat > 0) m.coatRoughness = clamped(from.Pcr.value_or(0));
}

bool isPhysical(const MtlMaterial& from) { return from.Pr || from.Pm || from.mapPr || from.mapPm; }

}  // namespace

Material defaultGrey(const std::string& name) {
  Material m;
  m.name = name;
  m.baseColor = Vec3(kGrey);
  m.metallic = 0, m.specular = 0;
  return m;
}

Material translate(const MtlMaterial& from) {
  const Reading r(from);
  Material m;
  m.name = from.name;
  m.metallic = 0;
  const bool glass = !isPhysical(from) && r.isGlass();
  if (glass)
    makeGlass(r, m);
  else if (isPhysical(from))
    makePhysical(r, m);
  else if (r.reflects())
    makeReflecting(r, m);
  else
    makeGloss(r, r.Ks, m);
  addLayers(from, m);
  if (!glass) m.opacity = r.opacity;
  if (m.opacity < 1) m.alphaMode = AlphaMode::blend;
  m.emission = colourUnder(from.mapKe, from.Ke, kAny);
  return m;
}

}  // namespace ninefold
