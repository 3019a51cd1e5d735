// renderer.h: what a client does with a scene: light sets and tasks. The door of common/gi.
//
// A Renderer is made once per scene and settings. After that everything is a pure function of its
// arguments: any client makes the same light set and the same tile, bit for bit. Another view of
// the same light costs next to nothing. Light sets do not depend on camera and size either, unless
// the method makes its light for a view (lightNeedsView in scene/methods.h).
//
// Owner:   refers to the Tracer.
// Threads: const functions are reentrant; each thread has its own Scratch.
// Errors:  constructor throws Error for settings that the scene cannot serve; TooLarge if there are
//          others that it can (method/too_large.h).
#pragma once

#include <memory>
#include <string>

#include "common/gi/method/method.h"

namespace ninefold {

class Renderer {
 public:
  // `begun`: of the scene that a gesture began with, under the same settings; null at rest. Counts,
  // shares and the photons' radii stay as they are in `begun` (transport.h).
  // `before`: of the same scene before an edit, under any settings; null: none. It may save work;
  // nothing else depends on it.
  Renderer(const Tracer& tracer, const Settings& settings, const Renderer* begun = nullptr,
           const Renderer* before = nullptr);
  // The light of `lit` seen by the camera, and in the size, of `settings`. The rest of `settings`
  // must be that of `lit`. Bit for bit what a new Renderer would be.
  Renderer(const Renderer& lit, const Settings& settings);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Light of set k of a frame. If it needs a view, it is made for the frame's light cameras, or for
  // this camera, in this size. Costs 0.1 to some ms; share it among the tasks that use it
  // (lightSetOfPhase).
  // `state`: what digest made of the pages of version frame.state; null for methods without state.
  std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                          const MethodState* state = nullptr) const;

  // Of the method's state, as in method.h. A step sees this camera, in this size. What a client is
  // sent names the job, which has them, so that all units of a step see the same.
  StepResult step(const StatePages& pages, const StepKey& step, uint32_t unit) const;
  std::shared_ptr<const MethodState> digest(const StatePages& pages,
                                            const MethodState* before = nullptr) const;

  // Renders one task into `out`; light = light(task.frame, lightSetOfPhase(task.phase, ...)).
  void render(const Task& task, const FrameLight& light, Scratch& scratch, TileResult& out) const;

  std::unique_ptr<Scratch> makeScratch() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The pixel class of this process: a hash of a small probe scene rendered by every method with
// `isa`, as 16 hex digits. Clients with equal probes give equal bytes.
std::string probeClass(Isa isa);

}  // namespace ninefold
