#include "common/tracing/part.h"

namespace ninefold {
namespace {

constexpr size_t kMovingParts = 7;

Hierarchy emptyHierarchy(RTCDevice device) {
  Hierarchy hierarchy(rtcNewScene(device));
  rtcSetSceneFlags(hierarchy.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(hierarchy.get(), RTC_BUILD_QUALITY_MEDIUM);
  return hierarchy;
}

}  // namespace

Part::Part(std::shared_ptr<const Device> device, const Scene& asRead, const Geometries& all,
           std::vector<uint32_t> instances)
    : device_(std::move(device)),
      instances_(std::move(instances)),
      hierarchy_(emptyHierarchy(device_->get())) {
  masks_.reserve(instances_.size());
  for (const uint32_t i : instances_) {
    geometries_.push_back(all[i]);
    const Mesh& mesh = all[i]->mesh();
    masks_.push_back({&asRead, &mesh, &asRead.materials[static_cast<size_t>(mesh.material)]});
    attach(i, *all[i], masks_.back());
  }
  rtcCommitScene(hierarchy_.get());
  throwOnError(device_->get(), "building the ray hierarchy");
}

void Part::attach(uint32_t instance, const InstanceGeometry& from, const AlphaMask& mask) {
  const Mesh& mesh = from.mesh();
  RTCGeometry geometry = rtcNewGeometry(device_->get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             from.vertices(), 0, sizeof(Vec3), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, sizeof(Triangle), mesh.triangles.size());
  if (mask.material->alphaMode == AlphaMode::mask) attachAlphaMask(geometry, mask);
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

std::vector<std::vector<uint32_t>> partition(const Scene& scene, const std::vector<bool>& moved) {
  std::vector<std::vector<uint32_t>> sets(1 + kMovingParts);
  for (uint32_t i = 0; i < moved.size(); ++i) {
    const auto node = static_cast<size_t>(scene.instances[i].node);
    sets[moved[i] ? 1 + node % kMovingParts : 0].push_back(i);
  }
  std::erase_if(sets, [](const auto& set) { return set.empty(); });
  return sets;
}

}  // namespace ninefold
