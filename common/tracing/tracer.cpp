#include "common/tracing/tracer.h"

#include <new>
#include <optional>

#include "common/base/error.h"
#include "common/tracing/contacts.h"
#include "common/tracing/device.h"
#include "common/tracing/geometry.h"
#include "common/tracing/packet.h"
#include "common/tracing/ray_log.h"

namespace ninefold {
namespace {

RTCRay singleRay(Vec3 origin, Vec3 direction, float tFar) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tfar = tFar;
  ray.mask = ~0u;
  return ray;
}

}  // namespace

struct Tracer::Impl {
  const Scene& scene;
  std::vector<InstanceGeometry> geometries;
  std::vector<AlphaMask> masks;
  Device device;
  Hierarchy hierarchy;
  std::optional<Contacts> contacts;
  std::string isaName;
  bool wide;  // Embree has 16-wide kernels here

  Impl(const Scene& s, Isa isa)
      : scene(s), device(makeDevice(isa)), isaName(isaOf(device.get())), wide(isaName == "avx512") {
    flatten();
    build();
  }

  void flatten() {
    geometries.reserve(scene.instances.size());
    masks.reserve(scene.instances.size());
    for (const Instance& instance : scene.instances) {
      const Mesh& mesh = geometries.emplace_back(scene, instance).mesh();
      masks.push_back({&scene, &mesh, &scene.materials[static_cast<size_t>(mesh.material)]});
    }
  }

  void build() {
    hierarchy.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(hierarchy.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(hierarchy.get(), RTC_BUILD_QUALITY_MEDIUM);
    for (size_t i = 0; i < geometries.size(); ++i) attach(i);
    rtcCommitScene(hierarchy.get());
    throwOnError(device.get(), "building the ray hierarchy");
    contacts.emplace(scene, geometries, masks, hierarchy.get());
  }

  void attach(size_t i) {
    const Mesh& mesh = geometries[i].mesh();
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               geometries[i].vertices(), 0, sizeof(Vec3), mesh.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.triangles.data(), 0, sizeof(Triangle), mesh.triangles.size());
    if (masks[i].material->alphaMode == AlphaMode::mask) attachAlphaMask(geometry, masks[i]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(hierarchy.get(), geometry, static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
  }
};

Tracer::Tracer(const Scene& scene, Isa isa) try : impl_(std::make_unique<Impl>(scene, isa)) {
} catch (const std::bad_alloc&) {
  fail("out of memory while flattening scene {}; use a smaller scene or a machine with more memory",
       scene.name);
}

Tracer::~Tracer() = default;

Hit Tracer::closest(Vec3 origin, Vec3 direction, float tFar) const {
  if (log_ != nullptr) log_->singles.push_back({origin, direction, tFar, false});
  if (!traceable(origin, direction, tFar)) return Hit::none();
  RTCRayHit query{};
  query.ray = singleRay(origin, direction, tFar);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::intersect1(impl_->hierarchy.get(), &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return Hit::none();
  return impl_->contacts->which(
      {query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar}, direction);
}

void Tracer::closest16(RayPacket& rays, uint32_t active, Hit* hits, bool coherent) const {
  if (log_ != nullptr) log_->packets.push_back({rays, active, false, coherent});
  RTCRayHit16 query;
  const uint32_t lanes = traceable(rays, active);
  intersectPacket(impl_->hierarchy.get(), impl_->wide, coherent, rays, lanes, query);
  const RTCHit16& hit = query.hit;
  for (int i = 0; i < kPacket; ++i) {
    if ((active >> i & 1) == 0) continue;
    hits[i] = Hit::none();
    if ((lanes >> i & 1) == 0 || hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    rays.farT[i] = query.ray.tfar[i];
    const Vec3 direction(rays.directionX[i], rays.directionY[i], rays.directionZ[i]);
    hits[i] = impl_->contacts->which(
        Hit{hit.geomID[i], hit.primID[i], hit.u[i], hit.v[i], rays.farT[i]}, direction);
  }
}

bool Tracer::occluded(Vec3 origin, Vec3 direction, float tFar) const {
  if (log_ != nullptr) log_->singles.push_back({origin, direction, tFar, true});
  if (!traceable(origin, direction, tFar)) return false;
  RTCRay ray = singleRay(origin, direction, tFar);
  embree::occluded1(impl_->hierarchy.get(), &ray);
  return ray.tfar < 0;
}

uint32_t Tracer::occluded16(RayPacket& rays, uint32_t active, bool coherent) const {
  if (log_ != nullptr) log_->packets.push_back({rays, active, true, coherent});
  const uint32_t lanes = traceable(rays, active);
  occludedPacket(impl_->hierarchy.get(), impl_->wide, coherent, lanes, rays);
  uint32_t blocked = 0;
  for (int i = 0; i < kPacket; ++i) blocked |= uint32_t(rays.farT[i] < 0) << i;
  return blocked & lanes;
}

SurfacePoint Tracer::surface(const Hit& hit) const {
  SurfacePoint p;
  p.instance = hit.instance;
  impl_->geometries[hit.instance].surface(hit.triangle, hit.u, hit.v, p);
  impl_->contacts->addTo(hit, p);
  return p;
}

Vec3 Tracer::clearOf(Vec3 p, Vec3 direction) const {
  return impl_->contacts->clearOf(p, direction);
}

Tracer::Corners Tracer::corners(uint32_t instance, uint32_t triangle) const {
  return impl_->geometries[instance].corners(triangle);
}

const Scene& Tracer::scene() const { return impl_->scene; }
const std::string& Tracer::isaName() const { return impl_->isaName; }

}  // namespace ninefold
