#include "common/tracing/tracer.h"

#include <new>
#include <numeric>
#include <optional>

#include "common/base/error.h"
#include "common/tracing/contacts.h"
#include "common/tracing/device.h"
#include "common/tracing/geometry.h"
#include "common/tracing/packet.h"
#include "common/tracing/part.h"
#include "common/tracing/ray_changes.h"
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
  const Scene& asRead;  // of the first tracer
  std::shared_ptr<const Device> device;
  std::string isaName;
  bool wide;  // Embree has 16-wide kernels here
  Geometries geometries;
  std::vector<bool> moved;   // by instance: elsewhere than as read, at least
  std::vector<bool> hidden;  // by instance: rays do not see it
  std::vector<AlphaMask> masks;
  std::shared_ptr<const MaskBits> bits;
  std::shared_ptr<const Part> all;                 // as it was read
  std::vector<std::shared_ptr<const Part>> parts;  // those beside it
  // By instance: the part that rays see it in; null if they do not.
  std::vector<std::shared_ptr<const Part>> shows;
  Hierarchies hierarchies;  // of all of them
  std::optional<Contacts> contacts;

  Impl(const Scene& s, Isa isa)
      : scene(s),
        asRead(s),
        device(std::make_shared<const Device>(makeDevice(isa))),
        isaName(isaOf(device->get())),
        wide(isaName == "avx512"),
        moved(s.instances.size(), false),
        hidden(s.instances.size(), false) {
    for (const Instance& instance : scene.instances)
      geometries.push_back(std::make_shared<const InstanceGeometry>(scene, instance));
    bits = std::make_shared<const MaskBits>(scene, geometries);
    std::vector<uint32_t> instances(scene.instances.size());
    std::iota(instances.begin(), instances.end(), 0u);
    all = std::make_shared<const Part>(device, asRead, geometries, *bits, std::move(instances));
    build(nullptr);
  }

  Impl(const Impl& before, const Scene& s, std::vector<bool> moves, std::vector<bool> hides)
      : scene(s),
        asRead(before.asRead),
        device(before.device),
        isaName(before.isaName),
        wide(before.wide),
        geometries(before.geometries),
        moved(std::move(moves)),
        hidden(std::move(hides)),
        bits(before.bits),
        all(before.all) {
    for (size_t i = 0; i < scene.instances.size(); ++i) {
      const Instance& instance = scene.instances[i];
      if (instance.toWorld != before.scene.instances[i].toWorld ||
          &scene.meshes[static_cast<size_t>(instance.mesh)] != &geometries[i]->mesh())
        geometries[i] = std::make_shared<const InstanceGeometry>(scene, instance);
    }
    build(&before);
  }

  void build(const Impl* before) {
    for (const auto& geometry : geometries)
      masks.push_back({&scene, &geometry->mesh(),
                       &scene.materials[static_cast<size_t>(geometry->mesh().material)]});
    const Partition beside = partition(asRead, *bits, moved, hidden);
    hierarchies.push_back({all->hierarchy(), beside.mask});
    for (const bool isHidden : hidden) shows.push_back(isHidden ? nullptr : all);
    for (const std::vector<uint32_t>& instances : beside.sets) {
      parts.push_back(part(before, instances));
      hierarchies.push_back({parts.back()->hierarchy(), ~0u});
      for (const uint32_t i : instances) shows[i] = parts.back();
    }
    contacts.emplace(scene, geometries, masks, hierarchies, *bits, hidden,
                     before != nullptr ? &*before->contacts : nullptr);
  }

  std::shared_ptr<const Part> part(const Impl* before,
                                   const std::vector<uint32_t>& instances) const {
    if (before != nullptr)
      for (const auto& old : before->parts)
        if (old->isOf(geometries, instances)) return old;
    return std::make_shared<const Part>(device, asRead, geometries, *bits, instances);
  }
};

Tracer::Tracer(const Scene& scene, Isa isa) try : impl_(std::make_unique<Impl>(scene, isa)) {
} catch (const std::bad_alloc&) {
  fail("out of memory while flattening scene {}; use a smaller scene or a machine with more memory",
       scene.name);
}

Tracer::Tracer(const Tracer& before, const Scene& scene, const std::vector<bool>& moved)
    : impl_(std::make_unique<Impl>(*before.impl_, scene, moved,
                                   std::vector<bool>(moved.size(), false))) {}

Tracer::Tracer(const Tracer& all, const std::vector<bool>& hidden)
    : impl_(std::make_unique<Impl>(*all.impl_, all.scene(), all.impl_->moved, hidden)) {}

Tracer::~Tracer() = default;

Hit Tracer::closest(Vec3 origin, Vec3 direction, float tFar) const {
  if (log_ != nullptr) log_->singles.push_back({origin, direction, tFar, false});
  if (!traceable(origin, direction, tFar)) return Hit::none();
  RTCRayHit query{};
  query.ray = singleRay(origin, direction, tFar);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  for (const SeenPart& part : impl_->hierarchies) {
    query.ray.mask = part.mask;
    embree::intersect1(part.hierarchy, &query);
  }
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return Hit::none();
  return impl_->contacts->which(
      {query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar}, direction);
}

void Tracer::closest16(RayPacket& rays, uint32_t active, Hit* hits, bool coherent) const {
  if (log_ != nullptr) log_->packets.push_back({rays, active, false, coherent});
  RTCRayHit16 query;
  const uint32_t lanes = traceable(rays, active);
  intersectPacket(impl_->hierarchies, impl_->wide, coherent, rays, lanes, query);
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
  for (const SeenPart& part : impl_->hierarchies) {
    ray.mask = part.mask;
    embree::occluded1(part.hierarchy, &ray);
    if (ray.tfar < 0) return true;
  }
  return false;
}

uint32_t Tracer::occluded16(RayPacket& rays, uint32_t active, bool coherent) const {
  if (log_ != nullptr) log_->packets.push_back({rays, active, true, coherent});
  const uint32_t lanes = traceable(rays, active);
  return occludedPacket(impl_->hierarchies, impl_->wide, coherent, lanes, rays);
}

SurfacePoint Tracer::surface(const Hit& hit) const {
  SurfacePoint p;
  p.instance = hit.instance;
  impl_->geometries[hit.instance]->surface(hit.triangle, hit.u, hit.v, p);
  impl_->contacts->addTo(hit, p);
  return p;
}

Vec3 Tracer::clearOf(Vec3 p, Vec3 direction) const {
  return impl_->contacts->clearOf(p, direction);
}

Tracer::Corners Tracer::corners(uint32_t instance, uint32_t triangle) const {
  return impl_->geometries[instance]->corners(triangle);
}

Vec3 Tracer::frontNormal(uint32_t instance, uint32_t triangle) const {
  return impl_->geometries[instance]->frontNormal(triangle);
}

std::shared_ptr<const RayAnswers> Tracer::answers() const {
  RayAnswers answers{
      impl_->shows, impl_->geometries, {}, impl_->contacts->touching(), impl_->contacts->margin()};
  for (uint32_t i = 0; i < answers.shows.size(); ++i)
    answers.ranks.push_back(impl_->contacts->rankOf(i));
  return std::make_shared<const RayAnswers>(std::move(answers));
}

const Scene& Tracer::scene() const { return impl_->scene; }
const std::string& Tracer::isaName() const { return impl_->isaName; }

}  // namespace ninefold
