// field_size.h: how large an intersection field becomes, before it is made.
//
// Every third slope a is scan-converted and its runs and hits are counted; the rest is taken to be
// like them. Slopes near by have almost as many, so that it errs by a few percent. Local fields
// that are there already need no count as long as half the room is left.
//
//   bytes = 16 runs + 4 pages + 4 slices       of each instance: local_field.h, line_field.h
//         + 12 lines that nodes keep + 16 nodes                  node_lines.h
//         + 64 nodes, for each lamp that has maps                lamp_pairs.h, at most
//
// Source:  made for this project.   Proved: tests/gi/field_size_test.cpp.
// Threads: pure functions.   Errors: checkFieldSize throws TooLarge, which says what would fit.
#pragma once

#include "common/gi/elements/element_light.h"
#include "common/gi/intersection_field/line_field.h"
#include "common/scene/settings.h"

namespace ninefold {

// What a field is made for.
struct FieldPlan {
  const Scene& scene;
  const Bounds box;  // that the lines pass through
  const SceneElements& elements;
  size_t lamps = 0;                   // that have maps
  const LineField* before = nullptr;  // of the scene before an edit
};

// About how many bytes all parts of a field take together.
double fieldBytes(const LineGrid& grid, const FieldPlan& plan);

// Refuses what takes more than settings.maxFieldMemory. plan.before makes no difference.
void checkFieldSize(const LineGrid& grid, const FieldPlan& plan, const Settings& settings);

}  // namespace ninefold
