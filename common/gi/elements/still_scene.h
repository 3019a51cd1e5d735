// still_scene.h: what a gesture leaves where it is, for mesh elements.
//
// What stands on a surface divides its nodes (node_parts.h). To look for it anew takes a client
// tens of milliseconds, which a drag would pay for each frame. So what moves in a gesture stands
// nowhere until the picture rests: rays for elements do not see it, and its own elements are not
// divided. What turns keeps the elements that it had. So elements stay for the whole gesture, and
// their light changes by hits that differ alone.
//
// Moves: an instance whose place or shape is another than in the scene that the gesture began with.
//
// Fails:   in a gesture light leaks under what moves, and what it covers is darker around it, both
//          within h. When the picture rests, light there jumps to what is right. What is scaled or
//          bent has new elements in each frame.
// Proved:  tests/gi/element_test.cpp.
// Threads: const after construction.   Owner: refers to the tracer.   Errors: none.
#pragma once

#include <memory>

#include "common/tracing/tracer.h"

namespace ninefold {

class StillScene {
 public:
  // `begun`: that a gesture began with; null at rest. Must outlive this.
  StillScene(const Tracer& all, const Scene* begun);

  const Scene* begun() const { return begun_; }
  // Does not see what moves.
  const Tracer& tracer() const { return still_ != nullptr ? *still_ : all_; }
  // Linear part of toWorld by which an instance's elements are cut. Of what only turned it is that
  // of the gesture's beginning.
  DMat3 linearOf(size_t instance) const;

 private:
  const Tracer& all_;
  const Scene* begun_;
  std::unique_ptr<const Tracer> still_;  // null: nothing moves
};

}  // namespace ninefold
