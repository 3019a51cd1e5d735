// job_offer.h: what every client is given: the scene as blobs, found by hash, and the settings.
// Constant after construction; shared read-only by all sessions.
#pragma once

#include <map>
#include <vector>

#include "proto/messages.h"
#include "proto/scene_blobs.h"

namespace ninefold {

class JobOffer {
 public:
  JobOffer(std::vector<Blob> blobs, const Settings& settings, const Delivery& delivery);
  JobOffer(const JobOffer&) = delete;
  JobOffer& operator=(const JobOffer&) = delete;

  msg::SceneOffer sceneOffer() const;
  msg::Configure configure() const { return {kScene, kJob, settings_, delivery_}; }
  // The piece that was asked for. Error: no such blob or place.
  msg::BlobChunk piece(const msg::BlobRequest& request) const;

  // There is one scene and one job in a run so far.
  static constexpr uint32_t kScene = 1, kJob = 1;

 private:
  const std::vector<Blob> blobs_;
  const Settings settings_;
  const Delivery delivery_;
  std::map<Sha256, const Blob*> byHash_;
};

}  // namespace ninefold
