// method.h: the computing half of a method: where its light comes from. What all methods share (eye
// paths, layers, filter, film, wire) lies outside. The other half, its facts, is plain data, which
// the master reads, too (scene/methods.h).
//
//   light      of one interleaved set: a pure function of (scene, settings, key, set, views)
//   render     one task, lit by it
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
  // methods whose light needs them (scene/methods.h).
  virtual std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                                  std::span<const View> views) const = 0;
  // `light`: of the task's frame and set. `scratch`: one that makeScratch made.
  virtual void render(const View& view, const Task& task, const FrameLight& light, Scratch& scratch,
                      TileResult& out) const = 0;
  virtual std::unique_ptr<Scratch> makeScratch() const = 0;

 protected:
  const Transport& t_;
};

}  // namespace ninefold
