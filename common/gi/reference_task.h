// reference_task.h: one task of the reference method: whole radiance as U of the diffuse layer,
// which no filter touches.
//
//   irradiance, caustic   E at the first hit, all of it or what came by way of S: pi times the radiance
//                         that a white matte surface there would send. Paths of their own, and only if
//                         asked for: nobody's picture changes.
//   reflectance           with the caustic plane, for who shows its share of the picture
//
// Threads: reentrant with one TaskContext a thread.   Errors: none.
#pragma once

#include "common/gi/task_context.h"

namespace ninefold {

void pathTraceTask(TaskContext& context);

}  // namespace ninefold
