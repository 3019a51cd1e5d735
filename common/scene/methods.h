// methods.h: what differs from method to method, as far as one can tell without tracing a ray: one
// row of facts for each. Master, wire, options, stats, panel, report and help read the row, so that
// none of them asks which method it is. What a method computes lies in common/gi.
//
// A new method is a value of Method (settings.h) and a row of the table in methods.cpp: see
// docs/adding-a-method.md.
// Threads: constant data, pure functions.   Errors: none.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/scene/needs.h"
#include "common/scene/settings.h"
#include "common/state/state_pages.h"

namespace ninefold {

// What light is made of. Settings and thinning in motion go by it.
enum LightPart : uint8_t {
  kDirectVpls = 1,
  kIndirectVpls = 2,
  kCausticPhotons = 4,
  kReverseVpls = 8,
  kMapPhotons = 16,      // of a pool that outlives frames
  kElementPhotons = 32,  // of a pool, kept as light of mesh elements
  kFieldPhotons = 64     // along lines, kept likewise
};
inline constexpr uint8_t kVpls = kDirectVpls | kIndirectVpls;

// A method whose light has a state that outlives a frame (common/state): what is to be known of its
// steps.
struct StateFacts {
  // Units of a step: of one that makes all of the state anew, and of one while the picture moves.
  // Without unitsInMotion one step serves all frames of a series at rest, and those in motion until
  // the next rest.
  uint32_t (*unitsOfAll)(const Settings& settings);
  uint32_t (*unitsInMotion)(const Settings& settings);
  bool servesAll() const { return unitsInMotion == nullptr; }
  double (*rays)(const Settings& settings);  // of a unit, about
  bool beginsAnew;                           // a step of all units needs no state before it
  bool isPaced;  // steps in motion may have other numbers of units, as many as there is time for
  // Whether the state of one stays right under the other: where not, it begins anew.
  bool (*isKept)(const Settings& before, const Settings& after);
  // A line for the log, said if what stands before its first comma is new; null: nothing.
  std::string (*describe)(const StatePages& pages) = nullptr;
  // Whether clients keep what an edit leaves alone, so that units after it are quick: a step of all
  // may be done before a frame begins. Null: never.
  bool (*remembers)(const Settings& settings) = nullptr;
};

struct MethodFacts {
  Method method;
  const char* name;   // of flags and files
  const char* title;  // for people, in the panel
  const char* help;   // in brackets behind its name; may be empty
  uint8_t parts;      // LightParts that it has, as bits: in motion there are fewer of each

  // All light is radiance U: tasks carry one layer, and nothing of it is filtered.
  bool isUnfiltered;
  bool lightNeedsView;          // a light set is made for a camera
  bool freeSets;                // a light set costs nothing, so that any client may take any task
  bool missesPunctualCaustics;  // cannot meet point, spot or directional lights by smooth surfaces
  double (*rays)(const Settings& settings, double pixels);  // of a task; see methods.cpp
  const StateFacts* state = nullptr;                        // null: no state
  bool isChoice = false;       // its pictures are those of another method, which its state tells
  const char* bias = nullptr;  // what stays wrong however many frames are averaged; null: nothing

  bool has(uint8_t part) const { return (parts & part) == part; }
};

// Photons of an intersection field that one unit of a step traces, and how many such rows there
// are.
inline constexpr uint32_t kPhotonsOfRow = 256;
inline uint32_t fieldRows(const Settings& s) {
  return (static_cast<uint32_t>(s.fieldPhotons) + kPhotonsOfRow - 1) / kPhotonsOfRow;
}

// In the order of Method. allMethods: without those that exist for tests alone.
std::span<const MethodFacts> allMethods();
std::span<const MethodFacts> methodTable();
const MethodFacts& factsOf(Method method);

// The layers that a task of this method carries; master and clients must agree on it.
uint8_t layerMaskOf(const Needs& needs, Method method);

// Whether pictures have light that photons bring.
bool usesPhotons(const Needs& needs, const Settings& settings);

// Whether `a` and `b` are the same but for camera and size.
bool differInViewAlone(const Settings& a, const Settings& b);

// Whether the light sets of `a` and `b` are the same, byte for byte.
bool haveSameLight(const Settings& a, const Settings& b);

// Text for a menu, "a (default), b (slow) or c": the names of all methods and what helps to choose.
std::string describeMethods();

// What these settings leave out of the picture: one line each, for warnings in the log.
std::vector<std::string> leftOut(const Needs& needs, const Settings& settings);

}  // namespace ninefold
