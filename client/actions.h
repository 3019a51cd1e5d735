// actions.h: what the client's session asks the program around it to do. Plain values, in order.
//
// `load` numbers the scene that is being fetched and built, `line` the connection that tasks came
// by. Answers carry both back, so that answers to a question of the past can be dropped.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "common/state/state_pages.h"
#include "proto/messages.h"

namespace ninefold::act {

// Dial the master once; answered by connected() or connectFailed().
struct Connect {};
struct Send {
  Message message;
};
// Send what is queued, then close. The session is offline from now on.
struct Disconnect {
  std::string reason;
};
// Look for the blobs of a manifest in the cache; answered by blobsFound().
struct FindBlobs {
  uint32_t load = 0;
  std::vector<BlobInfo> manifest;
};
// Verify a fetched blob and keep it; answered by sceneFailed() if it is not what it should be.
struct KeepBlob {
  uint32_t load = 0;
  BlobInfo blob;
  Bytes compressed;
};
// All blobs are there: make the scene ready for tracing; answered by sceneBuilt() or sceneFailed().
struct BuildScene {
  uint32_t load = 0;
};
// The scene as it was fetched has changed: jobs from here on see it so. `moving` and `more` as in
// msg::Edit. Answered by sceneFailed() if that cannot be.
struct EditScene {
  uint32_t load = 0;
  SceneEdit edit;
  bool moving = false, more = false;
};
// Back to the scene as it was fetched.
struct RestoreScene {
  uint32_t load = 0;
};
// Make a renderer of the built scene; answered by jobPrepared() or sceneFailed().
struct PrepareJob {
  uint32_t load = 0;
  uint32_t line = 0;
  uint32_t jobVersion = 0;
  Settings settings;
  Delivery delivery;
};
// Render; each task is answered by taskFinished(). `state`: pages of version tasks.frame.state.
struct StartTasks {
  uint32_t line = 0;
  msg::Tasks tasks;
  std::shared_ptr<const StatePages> state = nullptr;
};
// Each unit is answered by unitFinished(). `state`: pages of version steps.step.from.
struct StartSteps {
  uint32_t line = 0;
  msg::Steps steps;
  std::shared_ptr<const StatePages> state;
};
// Forget waiting units of steps before `number`.
struct CancelUnits {
  uint32_t number = 0;
};
// Forget waiting tasks of frames before `frame`; all of them, units too, if `everything`.
struct CancelTasks {
  uint32_t frame = 0;
  bool everything = false;
};
// A line for people.
struct Tell {
  std::string line;
};
// The program ends, after the connection has sent what is queued.
struct Exit {
  int status = 0;
  std::string line;
};

using Action = std::variant<Connect, Send, Disconnect, FindBlobs, KeepBlob, BuildScene, EditScene,
                            RestoreScene, PrepareJob, StartTasks, StartSteps, CancelTasks,
                            CancelUnits, Tell, Exit>;

}  // namespace ninefold::act
