// light_profile.h: how much light a lamp sends where, as a goniometer measured it: a table over two
// angles.
//
//   theta  vertical angle [degrees]: 0 along the lamp's axis, 180 against it
//   phi    horizontal angle [degrees]: about the axis, 0 towards `across`
//   w = cos(theta) axis + sin(theta) (cos(phi) across + sin(phi) cross(across, axis))
//   I(w) = I f(theta, phi)   I: the light's intensity [W/sr]
//
// f is bilinear in the angles within each cell of the table, and 0 at a theta that the table does
// not have. Its largest value is 1, so that I is the intensity where the lamp is brightest, and a
// profile that is 1 everywhere makes a point light, to the last bit.
//
//   Omega = integral of f over the sphere [sr],   Phi = I Omega [W]
//
// Angles are degrees, as photometric files have them: there 90 is the horizon, to the last bit.
//
// Where a lamp hangs with its axis down, theta is the angle from the nadir, and phi turns
// counterclockwise for somebody who looks down: type C of IES LM-63 (ies_file.h).
//
// Proved:  tests/scene/light_profile_test.cpp.
// Threads: plain data, pure functions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/math/vec.h"

namespace ninefold {

inline constexpr double kDegree = 0.017453292519943295769;  // [rad]

// Limits on all profiles of a scene together, and on what is read for them.
inline constexpr size_t kMaxProfileValues = 1 << 22;
inline constexpr uint64_t kMaxProfileBytes = 64 << 20;

struct LightProfile {
  std::string name;
  std::vector<float> vertical;    // theta [degrees]: two or more, ascending, in [0, 180]
  std::vector<float> horizontal;  // phi [degrees]: two or more, ascending, from 0 to 360
  std::vector<float> values;      // f: for each theta all phi

  float at(size_t row, size_t column) const { return values[row * horizontal.size() + column]; }
};

// f at angles in degrees; phi in [-360, 360].
float profileAt(const LightProfile& profile, float theta, float phi);

// The cell of the table that holds a direction: between `row` and the next one, at share `down` of
// the way, and likewise across.
struct ProfilePlace {
  size_t row = 0, column = 0;
  float down = 0, along = 0;

  // Exact where all four values are the same.
  template <typename Value>
  auto mix(const Value& value) const {
    const auto between = [](auto a, auto b, float t) { return a + t * (b - a); };
    return between(between(value(row, column), value(row, column + 1), along),
                   between(value(row + 1, column), value(row + 1, column + 1), along), down);
  }
};

// Towards unit w. axis, across: unit and perpendicular. Nothing at a theta that is not in the
// table.
std::optional<ProfilePlace> placeTowards(const LightProfile& profile, Vec3 axis, Vec3 across,
                                         Vec3 w);
// f there.
float profileTowards(const LightProfile& profile, Vec3 axis, Vec3 across, Vec3 w);

// Integral over theta of a value that goes straight from m0 at theta0 to m1 at theta1, times
// sin(theta): what a band of the table has, if m is the integral over phi. Angles in radians.
//
//   m0 (cos theta0 - cos theta1) + (m1 - m0)/h (sin theta1 - sin theta0 - h cos theta1),
//   h = theta1 - theta0
double bandIntegral(double theta0, double theta1, double m0, double m1);

// Omega [sr].
double solidAngleOf(const LightProfile& profile);

// Seen in a mirror that holds the axis and `across`: phi goes the other way round.
LightProfile mirrored(const LightProfile& profile);

// `v` made perpendicular to the unit `axis`, with length 1; another one that is if v is along it.
Vec3 acrossAxis(Vec3 axis, Vec3 v);

// Throws Error on what is no profile; `what` names it.
void checkProfile(const LightProfile& profile, const std::string& what);

}  // namespace ninefold
