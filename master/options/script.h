// script.h: a session written down: camera paths and edits over time, as docs/script.md describes.
// Pure: a time goes in, the camera and all edits up to then come out.
//
// Errors: parseScript throws Error that names file, event and field, also for a name that the scene
// lacks.
// Threads: plain value.   Proved: tests/master/script_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/edit.h"

namespace ninefold {

inline constexpr double kLongestScript = 86400;                    // [s]
inline constexpr double kSlowestRate = 1e-3, kFastestRate = 1000;  // pictures a second

struct ScriptState {
  Camera camera;
  SceneEdit edit;
  bool operator==(const ScriptState&) const = default;
};

class Script {
 public:
  // Something that goes on from one time to another, or happens at one.
  struct Event {
    double from = 0, to = 0;  // [s]
    enum class Kind : uint8_t { camera, object, light, material, animation } kind = Kind::camera;
    std::vector<Camera> path;  // camera: passed through at equal times; the first at `from`
    std::vector<int> nodes;    // object
    DVec3 centre{0}, by{0};    // object: turned about the vertical through centre, then shifted [m]
    double turn = 0;           // object [rad]
    double twist = 0;          // object: turned at its top against its foot [rad]
    double low = 0, high = 0;  // object: its foot and top as read [m]
    LightEdit light;           // at the end
    MaterialEdit material;     // at the end
    double playedFrom = 0, playedTo = 0;  // animation: times of the file [s]
  };

  double seconds = 0;           // length; 0: one moment
  std::optional<double> rate;   // pictures a second of script time; nothing: in real time
  std::optional<double> shots;  // in real time: a second, of what is on the screen then
  int frames = 1;               // of the film for each picture
  std::vector<Event> events;

  // Of a script that has a rate, or shots.
  int pictures() const;
  // Events of the same thing follow one another; before its first event a thing is as it was read.
  ScriptState at(double time, const Scene& scene, const Camera& start) const;
};

// `text`: JSON; `name`: of the file, for errors.
Script parseScript(const std::string& text, const std::string& name, const Scene& scene);
Script readScript(const std::string& path, const Scene& scene);

// The file's animation from one time to another, as a script. Error if the scene has none.
struct AnimationRange {
  double from = 0, to = 0;  // [s]
  double rate = 25;         // pictures a second
};
Script playedAnimation(const AnimationRange& range, int frames, const Scene& scene);

}  // namespace ninefold
