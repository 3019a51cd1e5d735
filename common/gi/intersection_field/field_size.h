// field_size.h: how large an intersection field becomes, before it is made.
//
// Every third slope a is scan-converted and its runs are counted; the rest is taken to be like
// them. Slopes near by have almost as many, so that it errs by a few percent.
//
//   bytes = 16 runs + 4 pages           local_field.h
//
// The lines of nodes come on top: 6 KiB a node or less (node_lines.h).
//
// Source:  made for this project.   Proved: tests/gi/line_field_test.cpp.
// Threads: pure functions.   Errors: checkFieldSize throws Error that says what would fit.
#pragma once

#include "common/scene/scene.h"
#include "common/scene/settings.h"

namespace ninefold {

// About how many bytes the local fields of a scene take.
double fieldBytes(const Scene& scene, int directions, int distances);

// Refuses what takes more than settings.maxFieldMemory.
void checkFieldSize(const Scene& scene, const Settings& settings);

}  // namespace ninefold
