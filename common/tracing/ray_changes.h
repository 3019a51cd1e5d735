// ray_changes.h: where rays may have other answers after an edit, to the last bit.
//
// An answer changes only near what is shown by another hierarchy: a thing that moved, and what
// shares a hierarchy with it (part.h). It changes also on a triangle that has begun or ceased to
// touch something transparent or bright, and on what has become so (contacts.h). So a ray that
// meets none of their boxes, neither where they were nor where they are, has the answer that it
// had. Other changes of materials are for the caller to compare.
//
// Proved:  tests/tracing/ray_changes_test.cpp.
// Owner:   keeps geometry and hierarchies of its state alive.
// Threads: const after construction.   Errors: none.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/math/bounds.h"
#include "common/math/units.h"

namespace ninefold {

class InstanceGeometry;
class Part;

struct RayAnswers {
  // By instance: the hierarchy that shows it; null: it is hidden.
  std::vector<std::shared_ptr<const Part>> shows;
  std::vector<std::shared_ptr<const InstanceGeometry>> geometries;
  std::vector<uint8_t> ranks;               // contacts.h
  std::vector<std::vector<bool>> touching;  // likewise
  Metres margin = 0;                        // likewise
};

// Of an instance, a little larger than it is: what touches it counts, too.
Bounds boxOf(const RayAnswers& answers, uint32_t instance);

// Boxes of all that changed, where it was and where it is. Nothing: any ray may have another
// answer. So it is if the scene's cover grew (cover.h).
std::optional<std::vector<Bounds>> rayChanges(const RayAnswers& before, const RayAnswers& now);

}  // namespace ninefold
