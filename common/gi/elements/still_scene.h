// still_scene.h: what a gesture leaves where it is, for mesh elements.
//
// What stands on a surface divides its nodes (node_parts.h). To look for it anew takes a client tens
// of milliseconds, which a drag would pay for each frame. So what moves in a gesture stands nowhere
// until it rests: rays for elements do not see it, and its own elements are not divided. What turns
// keeps the elements that it had. So elements stay as they are for the whole gesture, and their
// light changes by hits that differ alone.
//
// Moves: an instance whose place or shape is another than in the scene that the gesture began with.
//
// Fails:   in a gesture light leaks under what moves, and what it covers is darker around it, both
//          within h.
// Proved:  tests/gi/element_test.cpp.
// Threads: const after construction.   Owner: refers to the tracer.   Errors: none.
#pragma once

#include <memory>

#include "common/tracing/tracer.h"

namespace ninefold {

class StillScene {
 public:
  // `begun`: that a gesture began with; null at rest. Must outlive this.
  StillScene(const Tracer& all, const Scene* begun = nullptr);

  // Does not see what moves, and says so (partOf).
  const Tracer& tracer() const { return still_ != nullptr ? *still_ : all_; }
  // Of the instance's toWorld, as its elements are cut: the one before it turned.
  DMat3 linearOf(size_t instance) const;

 private:
  const Tracer& all_;
  const Scene* begun_;
  std::unique_ptr<const Tracer> still_;  // null: nothing moves
};

}  // namespace ninefold
