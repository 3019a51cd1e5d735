// tile_renderer.h: one task: eye paths of a tile's pixels of one phase, then irradiance from one
// light set.
//
//   1. sixteen eye rays a packet, 4x4 neighbours of the sub-plane; shading and splitting into
//   layers
//   2. VPLs and photons gathered for all receivers of a layer together
//
// Film positions are jittered per pixel by the frame's randomization (anti-aliasing), or at the
// centre. Threads: reentrant with one Scratch a thread.   Errors: none.
#pragma once

#include "common/gi/light_set.h"
#include "common/gi/renderer.h"
#include "common/gi/scratch.h"

namespace ninefold {

// Whose pixels they are. The settings of the Transport may be those of another view.
struct View {
  Camera camera;
  int width, height;
  MediumStack eyeMedia;  // the solids that the eye is inside of
};

void renderTask(const Transport& transport, const View& view, const Task& task,
                const LightSet& lights, Scratch& scratch, TileResult& out);

}  // namespace ninefold
