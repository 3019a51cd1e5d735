// job.h: what is to be rendered, made of the command line and the scene file. The run needs nothing
// else of the scene once that is packed for the clients.
// Errors: makeJob throws Error (bad scene, no such camera).   Threads: plain value.
#pragma once

#include <memory>
#include <optional>

#include "common/image/patch.h"
#include "common/scene/needs.h"
#include "common/scene/scene.h"
#include "common/scene/settings.h"
#include "master/options/options.h"
#include "master/serving/job_offer.h"

namespace ninefold {

struct Job {
  Settings settings;
  Needs needs;
  Delivery delivery;              // of headless runs, and of live ones that begin at rest
  FrameShape shape;               // of what clients send then
  Metres firstPhotonRadius = 0;   // [m]
  Metres sceneRadius = 0;         // R [m]
  std::optional<float> exposure;  // [EV]; nothing: by the picture
  std::string sceneHash;          // SHA-256 over the names of its blobs
  std::unique_ptr<JobOffer> offer;
  std::shared_ptr<const Scene> scene;  // kept if isLive(options)
};

// Reads the scene; the first log lines say what it needs and what will be done.
Job makeJob(const Options& options);

}  // namespace ninefold
