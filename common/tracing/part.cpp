#include "common/tracing/part.h"

#include <map>

#include "common/tracing/geometry.h"

namespace ninefold {
namespace {

constexpr size_t kMovingParts = 7;
constexpr uint32_t kBits = 32, kBitOfLarge = kBits - 1;

Hierarchy emptyHierarchy(RTCDevice device) {
  Hierarchy hierarchy(rtcNewScene(device));
  rtcSetSceneFlags(hierarchy.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(hierarchy.get(), RTC_BUILD_QUALITY_MEDIUM);
  return hierarchy;
}

}  // namespace

MaskBits::MaskBits(const Scene& asRead, const Geometries& geometries) {
  std::map<int, Bounds> nodes;
  for (size_t i = 0; i < geometries.size(); ++i) {
    Bounds& box = nodes[asRead.instances[i].node];
    box.add(geometries[i]->bounds().low), box.add(geometries[i]->bounds().high);
  }
  const bool areFew = nodes.size() <= kBits;
  std::map<int, uint32_t> bits;
  uint32_t next = 0;
  for (const auto& [node, box] : nodes) {
    const bool isLarge = !areFew && 2 * box.radius() >= asRead.bounds.radius();
    bits[node] = 1u << (isLarge ? kBitOfLarge : next++ % (areFew ? kBits : kBitOfLarge));
  }
  for (const Instance& instance : asRead.instances) bits_.push_back(bits[instance.node]);
}

Part::Part(std::shared_ptr<const Device> device, const Scene& asRead, const Geometries& all,
           const MaskBits& bits, std::vector<uint32_t> instances)
    : device_(std::move(device)),
      instances_(std::move(instances)),
      hierarchy_(emptyHierarchy(device_->get())) {
  masks_.reserve(instances_.size());
  for (const uint32_t i : instances_) {
    geometries_.push_back(all[i]);
    const Mesh& mesh = all[i]->mesh();
    masks_.push_back({&asRead, &mesh, &asRead.materials[static_cast<size_t>(mesh.material)]});
    attach(i, *all[i], masks_.back(), bits.of(i));
  }
  rtcCommitScene(hierarchy_.get());
  throwOnError(device_->get(), "building the ray hierarchy");
}

void Part::attach(uint32_t instance, const InstanceGeometry& from, const AlphaMask& mask,
                  uint32_t bit) {
  const Mesh& mesh = from.mesh();
  RTCGeometry geometry = rtcNewGeometry(device_->get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             from.vertices(), 0, sizeof(Vec3), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, sizeof(Triangle), mesh.triangles.size());
  if (mask.material->alphaMode == AlphaMode::mask) attachAlphaMask(geometry, mask);
  rtcSetGeometryMask(geometry, bit);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(hierarchy_.get(), geometry, instance);
  rtcReleaseGeometry(geometry);
}

bool Part::isOf(const Geometries& all, const std::vector<uint32_t>& instances) const {
  if (instances != instances_) return false;
  for (size_t i = 0; i < instances_.size(); ++i)
    if (all[instances_[i]] != geometries_[i]) return false;
  return true;
}

Partition partition(const Scene& asRead, const MaskBits& bits, const std::vector<bool>& moved,
                    const std::vector<bool>& hidden) {
  Partition made;
  for (uint32_t i = 0; i < moved.size(); ++i)
    if (moved[i] || hidden[i]) made.mask &= ~bits.of(i);
  made.sets.resize(1 + kMovingParts);
  for (uint32_t i = 0; i < moved.size(); ++i) {
    if (hidden[i]) continue;
    const auto node = static_cast<size_t>(asRead.instances[i].node);
    if (moved[i])
      made.sets[1 + node % kMovingParts].push_back(i);
    else if ((made.mask & bits.of(i)) == 0)
      made.sets[0].push_back(i);
  }
  std::erase_if(made.sets, [](const auto& set) { return set.empty(); });
  return made;
}

}  // namespace ninefold
