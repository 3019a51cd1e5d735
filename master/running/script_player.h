// script_player.h: plays a script for whoever shows it. A time goes in, what has changed since the
// last time comes out: only that travels, and what the script leaves alone is somebody else's.
// Times may go back; what the script has not touched by then is as it was read. A pure value.
// Errors: Error if the script leads out of what a scene may be.   Threads: one owner.
#pragma once

#include <memory>

#include "master/options/options.h"
#include "master/options/script.h"

namespace ninefold {

class ScriptPlayer {
 public:
  ScriptPlayer(Script script, std::shared_ptr<const Scene> scene, const Camera& start)
      : script_(std::move(script)), scene_(std::move(scene)), start_(start), shown_{start, {}} {}

  struct Step {
    std::optional<Camera> camera;
    SceneEdit edit;
  };
  Step moveTo(double time);
  const Script& script() const { return script_; }

 private:
  Script script_;
  std::shared_ptr<const Scene> scene_;
  Camera start_;
  ScriptState shown_;
};

// What --script or --animate say; nothing if neither is given.
std::optional<Script> scriptOf(const Options& options, const Scene& scene);

}  // namespace ninefold
