// settings.h: everything besides the scene that decides the bytes of a picture; part of every
// task's key. Names, ranges and texts of all members: settings_table.h. Ranges are enforced where
// values enter (command line, panel, wire).
// Threads: value types, the same on master and clients.
#pragma once

#include <cstdint>
#include <vector>

#include "common/math/camera.h"
#include "common/math/units.h"
#include "common/sampling/interleave.h"
#include "common/sampling/randomization.h"

namespace ninefold {

enum class Method : uint8_t {
  instantRadiosity,
  pathTrace,
  bidirectional,
  photonMap,
  selective,
  automatic,
  intersectionField,
#ifdef NINEFOLD_TEST_METHODS
  stateCheck,  // for tests alone (gi/state_check)
#endif
};
enum class Caustics : uint8_t { off, direct, all };
enum class PartitionRule : uint8_t { balance, equal };
enum class MapDistribution : uint8_t { random, frame, turn, nets };  // photon_map/shooting.h
enum class MapIndex : uint8_t { grid, tree };
enum class MapDirect : uint8_t { off, on };
enum class ElementRule : uint8_t { linear, buckets };  // elements/element_light.h
enum class FieldDirect : uint8_t { vpls, field };      // intersection_field/intersection_field.h
enum class FieldWeights : uint8_t { measure, alike };  // intersection_field/lamp_visibility.h
enum class MapEstimate : uint8_t { pixels, vertices };

struct Settings {
  Method method = Method::instantRadiosity;
  int width = 640, height = 480;
  Camera camera;
  Interleave interleave;
  int directVpls = 4;      // per set
  int indirectVpls = 18;   // per set, mean
  int photons = 1000;      // caustic photons per set
  int resampling = 10;     // r: candidates for each VPL that is kept (resampling.h)
  int cameraPoints = 128;  // M, per set (camera_points.h)
  PartitionRule partition = PartitionRule::balance;  // of paths that both families find
  int mapPhotons = 2000;                             // paths of the rolling pool
  int mapPerFrame = 100;                             // of them shot anew by one unit; divides them
  int mapNearest = 100;                              // m: hits that tell the light at a point
  float mapDistance = 0.125f;            // D: how far away they may be, as a fraction of R
  MapDirect mapDirect = MapDirect::off;  // whether the light straight from lamps is the pool's
  MapDistribution mapDistribution = MapDistribution::nets;
  MapIndex mapIndex = MapIndex::grid;
  int photonPool = 73728;     // Z: photons whose light mesh elements keep
  int photonGroups = 288;     // N_g: groups of them that are traced at a time (photon_groups.h)
  int pilotRatio = 16;        // R: all photons of a group over its pilots
  float minorLamps = 0;       // F: share of all power of lamps whose direct light is photons'
  float elementSize = 0.08f;  // h: side of an element, as a fraction of R
  ElementRule elementRule = ElementRule::linear;
  int fieldDirections = 19;  // N: slopes of lines, horizontal and vertical (line_grid.h)
  int fieldDistances = 32;   // M: lines of each slope side by side
  int fieldPhotons = 65536;  // photons along lines whose light mesh elements keep
  FieldDirect fieldDirect = FieldDirect::vpls;        // who brings light straight from area lamps
  FieldWeights fieldWeights = FieldWeights::measure;  // of pairs that tell how much one sees
  int maxFieldMemory = 1024;                          // [MiB]
  MapEstimate mapEstimate = MapEstimate::pixels;      // where photons tell the light
  int mapSubdivision = 3;      // levels of the mesh whose vertices they tell it at
  int pathLength = 0;          // D vertices of a whole path, x included; 0 = no limit (roulette)
  int specularDepth = 32;      // S vertices in a row
  float bound = 30;            // c of b = c/R^2
  float vplRoulette = 4;       // f of vpl_roulette.h, 0: ask all
  float photonRadius = 0.02f;  // first photon radius as a fraction of R
  Caustics caustics = Caustics::all;
  Radiance environment{0};
  uint64_t seed = 1;
  Randomization randomization = Randomization::owen;
  bool jitter = true;      // anti-aliasing: film positions spread over the pixel
  bool compensate = true;  // give the bounded geometry term its energy back (compensation.h)

  bool operator==(const Settings&) const = default;
};

inline constexpr size_t kMostLightCameras = 8;

// What changes from frame to frame. At rest frame i has randomization i and rotation i. While
// anything moves both stay, so that nothing flickers.
struct FrameKey {
  uint32_t frame = 0;          // counts frames of a run; names a task on the wire
  uint32_t randomization = 0;  // randomization index
  uint32_t rotation = 0;       // of the interleave pattern, see interleave.h
  Metres photonRadius = 0;     // r of this frame [m]
  // Those that light is made for, where a method's light needs the view (methods.h): in motion the
  // last few, so that it changes little from frame to frame. None: the picture's own.
  std::vector<Camera> lightCameras = {};
  uint32_t state = 0;  // version of the method's state that the frame is lit by; 0: there is none
};

// What changes from step to step of a method's state. A step makes version `to` of version `from`
// by units of work, each of which any client may do.
struct StepKey {
  uint32_t number = 0;         // names a step on the wire; one count for frames and steps
  uint32_t from = 0, to = 1;   // from 0: the empty state
  uint32_t firstUnit = 0;      // units are counted through all steps of a state
  uint32_t randomization = 0;  // index, as in FrameKey
  uint32_t units = 1;          // of this step
  bool operator==(const StepKey&) const = default;
};

}  // namespace ninefold
