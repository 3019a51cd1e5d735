#include "master/running/job.h"

#include "common/base/log.h"
#include "common/scene/methods.h"
#include "common/scene/photon_scene.h"
#include "common/scene/reader.h"
#include "proto/scene_blobs.h"

namespace ninefold {
namespace {

uint8_t extraPlanes(const Options& options, const Needs& needs) {
  if (!options.aovs) return planesOf(options.view);
  const bool photons = needs.caustics && options.settings.caustics != Caustics::off;
  return static_cast<uint8_t>(
      kAlbedoPlane | kNormalPlane | kDepthPlane | kObjectPlane | (photons ? kCausticPlane : 0) |
      (factsOf(options.settings.method).isUnfiltered ? kIrradiancePlane : 0) |
      planesOf(options.view));
}

std::string hashOf(const std::vector<Blob>& blobs) {
  Bytes names;
  for (const Blob& blob : blobs)
    for (const uint8_t byte : blob.info.hash) names.push_back(static_cast<std::byte>(byte));
  return hex(sha256(names));
}

std::string candidatesOf(const Settings& s) {
  if (!factsOf(s.method).has(kReverseVpls)) return "";
  return fmt::format(" (up to {} candidates for each, chosen by {} camera points)", s.resampling,
                     s.cameraPoints);
}

void tellSettings(const Options& options, const Settings& s) {
  const std::string length =
      s.pathLength == 0 ? "no limit of path length" : fmt::format("path length {}", s.pathLength);
  log("{}x{} pixels, camera {}, preset {}: {}x{} light sets of {} + {} VPLs{} and {} photons, {}, "
      "seed {}",
      s.width, s.height, s.camera.name.empty() ? "as given" : s.camera.name, nameOf(options.preset),
      s.interleave.n, s.interleave.m, s.directVpls, s.indirectVpls, candidatesOf(s), s.photons,
      length, s.seed);
}

Delivery deliveryOf(const Options& options) {
  Delivery delivery;
  delivery.level = options.wireLevel;
  delivery.filter = options.surfaceTest;
  if (filtersAtClients(options, options.view)) delivery.form = Delivery::Form::radiance;
  return delivery;
}

void tellPhotonScene(const Options& options, const Scene& scene) {
  if (options.photonScene)
    log("photons meet {}; what is seen up to {:g} m off it is lit", *options.photonScene,
        options.settings.mapDistance * scene.bounds.radius() / 8);
}

// The scene's own suits its own light, not a sky that the command line puts around it.
std::optional<float> exposureOf(const Options& options, const Scene& scene) {
  if (options.autoExposure || options.exposure || scene.environmentMap) return options.exposure;
  return scene.exposure;
}

}  // namespace

Job makeJob(const Options& options) {
  Job job;
  auto read = std::make_shared<const Scene>(readScene(options.scene, options.reading));
  const Scene& scene = *read;
  job.settings = settingsFor(isLive(options) ? PictureView::beauty : options.view,
                             makeSettings(options, scene));
  job.needs = needsOf(scene, job.settings.environment);
  for (const std::string& line : describe(job.needs)) log("{}", line);
  tellSettings(options, job.settings);
  tellPhotonScene(options, scene);
  for (const std::string& line : leftOut(job.needs, job.settings)) warn("{}", line);
  if (const MethodFacts& facts = factsOf(job.settings.method); facts.bias != nullptr)
    log("{}: {}; the stated error is of noise alone", facts.name, facts.bias);
  const TileGrid grid(job.settings.width, job.settings.height, job.settings.interleave);
  job.delivery = deliveryOf(options);
  job.shape = job.delivery.wholeTiles()
                  ? FrameShape{grid, kRadianceMask, 0}
                  : FrameShape{grid, layerMaskOf(job.needs, job.settings.method),
                               extraPlanes(options, job.needs)};
  job.sceneRadius = scene.bounds.radius();
  job.exposure = exposureOf(options, scene);
  job.firstPhotonRadius = job.settings.photonRadius * scene.bounds.radius();
  std::vector<Blob> blobs = packScene(withPhotonScene(scene, options.photonScene));
  job.sceneHash = hashOf(blobs);
  job.offer = std::make_unique<JobOffer>(std::move(blobs), job.settings, job.delivery);
  if (isLive(options)) job.scene = std::move(read);
  return job;
}

}  // namespace ninefold
