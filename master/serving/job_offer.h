// job_offer.h: what every client is given: the scene as blobs, found by hash, all edits of it, and
// the settings of the current job.
// Threads: the scene is constant; the job is the network thread's, once that runs.
#pragma once

#include <map>
#include <vector>

#include "proto/messages.h"
#include "proto/scene_blobs.h"

namespace ninefold {

// The piece of a blob that was asked for. Error: it has no such place.
msg::BlobChunk pieceOf(const Blob& blob, const msg::BlobRequest& request);

class JobOffer {
 public:
  JobOffer(std::vector<Blob> blobs, const Settings& settings, const Delivery& delivery);
  JobOffer(const JobOffer&) = delete;
  JobOffer& operator=(const JobOffer&) = delete;

  msg::SceneOffer sceneOffer() const;
  msg::Configure configure() const { return {kScene, job_, settings_, delivery_}; }
  uint32_t job() const { return job_; }
  // The job has changed: `version` is larger than before.
  void setJob(uint32_t version, const Settings& settings, const Delivery& delivery);
  // The scene has changed: `version` is larger than before. Gives the messages for clients that
  // have all edits before it. allEdits: for clients that come later; empty without edits.
  std::vector<msg::Edit> setEdit(uint32_t version, const SceneEdit& edit, bool moving);
  std::vector<msg::Edit> allEdits() const;
  uint32_t edits() const { return version_; }
  // The piece that was asked for. Error: no such blob or place.
  msg::BlobChunk piece(const msg::BlobRequest& request) const;

  static constexpr uint32_t kScene = 1;  // there is one scene in a run

 private:
  const std::vector<Blob> blobs_;
  uint32_t version_ = 0;  // of the scene
  EditsSoFar edits_;
  uint32_t job_ = 1;
  Settings settings_;
  Delivery delivery_;
  std::map<Sha256, const Blob*> byHash_;
};

}  // namespace ninefold
