// method.h: the computing half of a method: where its light comes from. What all methods share (eye
// paths, layers, filter, film, wire) lies outside. The other half, its facts, is plain data, which
// the master reads, too (scene/methods.h).
//
//   light      of one interleaved set: a pure function of (scene, settings, key, set, views, state)
//   render     one task, lit by it
//   step       one unit of a step of the method's state: a pure function of (scene, settings, key,
//              unit, view, pages); only methods whose facts name a state
//   digest     the pages made ready to be asked: a function of the pages alone
//
// A method is made once per scene and settings, on each client alike. Methods never include each
// other. How to add one: docs/adding-a-method.md.
//
// Threads: const functions are reentrant; each thread has a Scratch of its own.
// Owner: refers to the Transport that it was made of.   Errors: none.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "common/gi/eye/task.h"
#include "common/image/layers.h"
#include "common/state/state_pages.h"

namespace ninefold {

// What a method makes of one interleaved set, to be shared by the set's tasks. Constant once made.
struct FrameLight {
  FrameLight() = default;
  FrameLight(FrameLight&&) = default;
  virtual ~FrameLight() = default;
  // The first value that is no number, as text: "VPL 3 has a power of (nan, 0, 0)". Empty: none.
  virtual std::string oddValue() const { return {}; }

  RayCounts rays;  // what making it cost
};

// What a method makes of its state's pages, to be shared by all frames of that version. Constant
// once made.
struct MethodState {
  virtual ~MethodState() = default;
};

// What a unit of a step does to the state's pages.
struct StepResult {
  PageDeltas deltas;  // no page twice
  RayCounts rays;
};

// Working memory of one thread, kept between tasks.
struct Scratch {
  virtual ~Scratch() = default;
};

class GiMethod {
 public:
  explicit GiMethod(const Transport& transport) : t_(transport) {}
  virtual ~GiMethod() = default;
  GiMethod(const GiMethod&) = delete;
  GiMethod& operator=(const GiMethod&) = delete;

  // Light of set `set` of a frame. `views`: one or more that it is made for; they count only for
  // methods whose light needs them (scene/methods.h). `state`: that digest made of version
  // frame.state; null for methods without one.
  virtual std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                                  std::span<const View> views,
                                                  const MethodState* state) const = 0;
  // `light`: of the task's frame and set. `scratch`: one that makeScratch made.
  virtual void render(const View& view, const Task& task, const FrameLight& light, Scratch& scratch,
                      TileResult& out) const = 0;
  virtual std::unique_ptr<Scratch> makeScratch() const = 0;

  // `pages`: of version step.from. `unit`: counted as step.firstUnit is.
  // `view`: of the picture when the step was opened.
  virtual StepResult step(const StatePages& pages, const StepKey& step, uint32_t unit,
                          const View& view) const;
  // `before`: of an earlier version under the same method, maybe of the scene before an edit; or
  // null. It may save work; it must not change the result.
  virtual std::shared_ptr<const MethodState> digest(const StatePages& pages,
                                                    const MethodState* before) const;

 protected:
  const Transport& t_;
};

}  // namespace ninefold
