// scene_builder.h: a thread for what takes long about a scene: looking into the cache, verifying,
// decoding, building the hierarchy. The network thread goes on answering the master meanwhile.
//
// Questions are the session's actions, answered in their order. Fetched blobs stay in memory until
// a scene was built of them, so that a connection lost in mid-transfer costs nothing again.
// Threads: ask from one thread; answers come on the builder's thread.
// Owner: joins when destroyed.   Errors: everything that goes wrong is answered by `failed`.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include "client/actions.h"
#include "client/blob_cache.h"
#include "client/render_job.h"
#include "common/base/concurrency.h"

namespace ninefold {

class SceneBuilder {
 public:
  struct Answers {
    std::function<void(uint32_t load, std::vector<BlobInfo> missing)> found;
    std::function<void(uint32_t load)> built;
    std::function<void(const act::PrepareJob&, std::shared_ptr<RenderJob>)> prepared;
    std::function<void(uint32_t load, std::string line)> failed;
  };

  SceneBuilder(std::optional<BlobCache> cache, Isa isa, int threads, Answers answers);
  ~SceneBuilder();
  SceneBuilder(const SceneBuilder&) = delete;
  SceneBuilder& operator=(const SceneBuilder&) = delete;

  void ask(act::FindBlobs&& question);
  void ask(act::KeepBlob&& question);
  void ask(act::BuildScene question);
  void ask(act::EditScene&& question);
  void ask(act::RestoreScene question);
  void ask(act::PrepareJob&& question);

 private:
  template <typename Question>
  void queue(Question question);
  void answer(act::FindBlobs& question);
  void answer(act::KeepBlob& question);
  void answer(const act::BuildScene& question);
  void answer(const act::EditScene& question);
  void answer(const act::RestoreScene& question);
  void answer(const act::PrepareJob& question);
  bool have(const BlobInfo& blob);

  const Isa isa_;
  const int threads_;
  const Answers answers_;
  // The builder's thread only.
  std::optional<BlobCache> cache_;
  std::vector<BlobInfo> manifest_;
  std::map<Sha256, Bytes> raw_;
  std::shared_ptr<const TracedScene> scene_;
  SceneEdit edits_;  // that scene_ has had
  std::shared_ptr<const RenderJob> latest_;

  BoundedQueue<std::function<void()>> queue_;
  std::thread thread_;
};

}  // namespace ninefold
