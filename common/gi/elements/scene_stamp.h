// scene_stamp.h: a number that tells two states of a scene apart, as far as photons feel them.
//
//   where its instances are and what shapes they have, what materials and punctual lights are like,
//   which lamps there are, and which of them are minor (light/minor_lamps.h)
//
// Images stay as they were read; edits cannot change them.
//
// Proved:  tests/gi/group_pages_test.cpp.   Threads: pure function.   Errors: none.
#pragma once

#include <cstdint>

#include "common/gi/light/minor_lamps.h"
#include "common/gi/light/transport.h"

namespace ninefold {

// Of what edits can change about a material.
uint64_t materialStamp(const Material& material);

// Of how photons start: lamps, their shares of the photons, and the ball around the scene.
// minor: the lamps whose direct light these photons bring.
uint64_t lampsStamp(const Transport& transport, const MinorLamps& minor);

uint64_t sceneStamp(const Transport& transport, const MinorLamps& minor);

}  // namespace ninefold
