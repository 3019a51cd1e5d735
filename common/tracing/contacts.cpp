#include "common/tracing/contacts.h"

#include <tuple>

#include "common/math/rounding.h"
#include "common/scene/needs.h"

namespace ninefold {
namespace {

// Errors of triangles that are no slivers stay below this share of the scene's radius.
constexpr float kMargin = 100 * kUnitRoundoff;
// A point this far outside of a triangle [barycentrics] is still in it: none falls between two.
constexpr double kSlack = 1e-6;
// Cosine to a surface's normal below which a view counts as along the surface.
constexpr float kAlong = 1e-3f;

bool isSolid(const Material& m) { return m.solid && transmits(m); }

int opacity(const Material& m) {
  if (m.alphaMode == AlphaMode::blend || (transmits(m) && !m.solid)) return 0;
  return isSolid(m) ? 1 : 2;
}

Vec3 lowOf(const Tracer::Corners& t) { return glm::min(t.a, glm::min(t.b, t.c)); }
Vec3 highOf(const Tracer::Corners& t) { return glm::max(t.a, glm::max(t.b, t.c)); }

float errorAt(const Tracer::Corners& t, Vec3 normal, Vec3 p) {
  return triangleError(t.a, t.b, t.c, normal, p);
}

// Distance from t's plane.
float planeDistance(const Tracer::Corners& t, Vec3 normal, Vec3 p) {
  return static_cast<float>(std::abs(glm::dot(DVec3(p) - DVec3(t.a), DVec3(normal))));
}

bool liesInPlane(const Tracer::Corners& t, const Tracer::Corners& plane, Vec3 n, Vec3 planeN) {
  for (const Vec3& p : {t.a, t.b, t.c})
    if (planeDistance(plane, planeN, p) > errorAt(t, n, p) + errorAt(plane, planeN, p))
      return false;
  return true;
}

bool boxesMeet(const Tracer::Corners& s, const Tracer::Corners& t, float margin) {
  return glm::all(glm::lessThanEqual(lowOf(s), highOf(t) + margin)) &&
         glm::all(glm::lessThanEqual(lowOf(t), highOf(s) + margin));
}

// Barycentrics of p's foot point in t.
glm::dvec2 barycentrics(const Tracer::Corners& t, Vec3 p) {
  const DVec3 a(t.a), e1 = DVec3(t.b) - a, e2 = DVec3(t.c) - a, w = DVec3(p) - a;
  const DVec3 n = glm::cross(e1, e2);
  const double n2 = glm::dot(n, n);
  return {glm::dot(glm::cross(w, e2), n) / n2, glm::dot(glm::cross(e1, w), n) / n2};
}

bool isInside(glm::dvec2 uv) {
  return uv.x >= -kSlack && uv.y >= -kSlack && uv.x + uv.y <= 1 + kSlack;
}

}  // namespace

// Calls visit(instance, triangle) for every triangle whose box is near p.
template <typename Visit>
void Contacts::forEachNear(Vec3 p, float radius, Visit visit) const {
  RTCPointQuery query{p.x, p.y, p.z, 0, radius};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  uint32_t mask = 0;
  auto visitSeen = [&](uint32_t instance, uint32_t triangle) {
    if ((mask & bits_->of(instance)) != 0) visit(instance, triangle);
  };
  const auto callback = [](RTCPointQueryFunctionArguments* found) {
    (*static_cast<decltype(visitSeen)*>(found->userPtr))(found->geomID, found->primID);
    return false;
  };
  for (const SeenPart& part : parts_) {
    mask = part.mask;
    rtcPointQuery(part.hierarchy, &query, &context, callback, &visitSeen);
  }
}

Contacts::Contacts(const Scene& scene, const Geometries& geometries,
                   const std::vector<AlphaMask>& masks, const Hierarchies& parts,
                   const MaskBits& bits, const std::vector<bool>& hidden, const Contacts* before)
    : scene_(&scene),
      geometries_(geometries),
      masks_(&masks),
      parts_(parts),
      bits_(&bits),
      margin_(kMargin * coverRadius(scene)),
      from_(geometries.size()),
      touching_(geometries.size()) {
  if (before != nullptr && before->margin_ != margin_) before = nullptr;
  const std::vector<Bounds> changed =
      before != nullptr ? changedSince(*before) : std::vector<Bounds>();
  for (uint32_t i = 0; i < geometries.size(); ++i) {
    if (hidden[i] || (opacity(material(i)) == 2 && isBlack(material(i).emission))) continue;
    const bool known = before != nullptr && before->from_[i] != nullptr && !isNear(i, changed);
    from_[i] = known ? before->from_[i] : std::make_shared<const Marks>(findFrom(i));
    for (const auto& [one, other] : *from_[i])
      if (!hidden[other.first]) mark(one), mark(other);
  }
}

// Bounds of everything that has moved, where it was and where it is.
std::vector<Bounds> Contacts::changedSince(const Contacts& before) const {
  std::vector<Bounds> boxes;
  for (size_t i = 0; i < geometries_.size(); ++i) {
    if (geometries_[i] == before.geometries_[i]) continue;
    boxes.push_back(geometries_[i]->bounds());
    boxes.push_back(before.geometries_[i]->bounds());
  }
  return boxes;
}

bool Contacts::isNear(uint32_t instance, const std::vector<Bounds>& changed) const {
  const Bounds& own = geometries_[instance]->bounds();
  for (const Bounds& box : changed)
    if (glm::all(glm::lessThanEqual(own.low, box.high + 4 * margin_)) &&
        glm::all(glm::lessThanEqual(box.low, own.high + 4 * margin_)))
      return true;
  return false;
}

const Material& Contacts::material(uint32_t instance) const {
  return *(*masks_)[instance].material;
}

Contacts::Face Contacts::face(uint32_t instance, uint32_t triangle) const {
  const InstanceGeometry& geometry = *geometries_[instance];
  return {instance, triangle, geometry.corners(triangle), geometry.frontNormal(triangle)};
}

uint8_t Contacts::rankOf(uint32_t instance) const {
  const Material& m = material(instance);
  return static_cast<uint8_t>(2 * opacity(m) + (isBlack(m.emission) ? 0 : 1));
}

void Contacts::mark(const Mark& mark) {
  const auto& [instance, triangle] = mark;
  std::vector<bool>& flags = touching_[instance];
  if (flags.empty()) flags.resize(geometries_[instance]->mesh().triangles.size());
  flags[triangle] = true;
}

Contacts::Marks Contacts::findFrom(uint32_t instance) const {
  Marks marks;
  const size_t count = geometries_[instance]->mesh().triangles.size();
  for (uint32_t i = 0; i < count; ++i) {
    const Face one = face(instance, i);
    const Vec3 low = lowOf(one.at), high = highOf(one.at);
    const auto visit = [&](uint32_t otherInstance, uint32_t otherTriangle) {
      const Face other = face(otherInstance, otherTriangle);
      const float cosine = glm::dot(one.normal, other.normal);
      if (std::abs(cosine) < 0.9f || (otherInstance == instance && cosine > 0)) return;
      if (!boxesMeet(one.at, other.at, margin_)) return;
      if (!liesInPlane(one.at, other.at, one.normal, other.normal) &&
          !liesInPlane(other.at, one.at, other.normal, one.normal))
        return;
      marks.push_back({{instance, i}, {otherInstance, otherTriangle}});
    };
    forEachNear(0.5f * (low + high), 0.5001f * glm::length(high - low) + margin_, visit);
  }
  return marks;
}

std::vector<Contacts::Contact> Contacts::at(const Hit& hit, Vec3 p) const {
  const Face own = face(hit.instance, hit.triangle);
  const float ownError = errorAt(own.at, own.normal, p);
  std::vector<Contact> found;
  const auto visit = [&](uint32_t instance, uint32_t triangle) {
    const Face f = face(instance, triangle);
    const bool sameSide = glm::dot(own.normal, f.normal) > 0;
    if ((instance == own.instance && sameSide) || isBlack(f.normal)) return;
    const float distance = planeDistance(f.at, f.normal, p), error = errorAt(f.at, f.normal, p);
    if (distance > std::min(ownError + error, margin_)) return;
    const glm::dvec2 uv = barycentrics(f.at, p);
    if (!isInside(uv)) return;
    const auto u = static_cast<float>(uv.x), v = static_cast<float>(uv.y);
    if ((*masks_)[instance].material->alphaMode == AlphaMode::mask &&
        (*masks_)[instance].isOpen(triangle, u, v))
      return;
    found.push_back({instance, triangle, u, v, sameSide, distance + error});
  };
  forEachNear(p, margin_, visit);
  // One face of each side of an instance, also on the edge between two.
  const auto key = [](const Contact& c) { return std::tuple(c.instance, c.sameSide, c.triangle); };
  std::sort(found.begin(), found.end(),
            [&](const Contact& a, const Contact& b) { return key(a) < key(b); });
  const auto last = std::unique(found.begin(), found.end(), [](const Contact& a, const Contact& b) {
    return a.instance == b.instance && a.sameSide == b.sameSide;
  });
  found.erase(last, found.end());
  return found;
}

Hit Contacts::foremost(const Hit& hit, Vec3 direction) const {
  const auto rank = [&](const Hit& h) {
    const Material& m = material(h.instance);
    const bool front = glm::dot(face(h.instance, h.triangle).normal, direction) < 0;
    const bool emits = !isBlack(m.emission) && (front || m.doubleSided);
    return std::tuple(opacity(m), emits, front, ~h.instance, ~h.triangle);
  };
  const Tracer::Corners own = geometries_[hit.instance]->corners(hit.triangle);
  Hit best = hit;
  for (const Contact& c : at(hit, pointOnTriangle(own.a, own.b, own.c, hit.u, hit.v))) {
    const Hit other{c.instance, c.triangle, c.u, c.v, hit.t};
    if (rank(other) > rank(best)) best = other;
  }
  return best;
}

Vec3 Contacts::clearOf(Vec3 p, Vec3 direction) const {
  Vec3 moved = p;
  const auto visit = [&](uint32_t instance, uint32_t triangle) {
    const Face f = face(instance, triangle);
    const float error = errorAt(f.at, f.normal, p);
    const auto height = static_cast<float>(glm::dot(DVec3(moved) - DVec3(f.at.a), DVec3(f.normal)));
    if (isBlack(f.normal) || std::abs(height) > error || !isInside(barycentrics(f.at, p))) return;
    Vec3 side = f.normal;
    if (std::abs(height) > storageError(p, f.normal))
      side *= height;
    else if (std::abs(glm::dot(f.normal, direction)) >= kAlong)
      side = direction;
    moved = offsetOrigin(moved, f.normal, 2 * error, side);
  };
  forEachNear(p, margin_, visit);
  return moved;
}

void Contacts::addSolids(const Hit& hit, SurfacePoint& p) const {
  for (const Contact& c : at(hit, p.position)) {
    p.error = std::max(p.error, c.reach);
    if (!isSolid(material(c.instance)) || p.contactCount == SurfacePoint::kMaxContacts) continue;
    p.contacts[static_cast<size_t>(p.contactCount++)] = {geometries_[c.instance]->mesh().material,
                                                         c.sameSide};
  }
}

}  // namespace ninefold
