#include "common/scene/light_profile.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/math/basis.h"
#include "common/math/units.h"

namespace ninefold {
namespace {

// Where x lies in an ascending list: between i and i + 1, at share t of the way.
struct Place {
  size_t i = 0;
  float t = 0;
};

Place placeIn(const std::vector<float>& angles, float x) {
  const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, x);
  const auto i = static_cast<size_t>(above - angles.begin()) - 1;
  const float t = (x - angles[i]) / (angles[i + 1] - angles[i]);
  return {i, std::clamp(t, 0.0f, 1.0f)};
}

std::optional<ProfilePlace> placeAt(const LightProfile& p, float theta, float phi) {
  if (!(theta >= p.vertical.front() && theta <= p.vertical.back())) return std::nullopt;
  if (phi < 0) phi += 360;
  const Place row = placeIn(p.vertical, theta), column = placeIn(p.horizontal, phi);
  return ProfilePlace{row.i, column.i, row.t, column.t};
}

float valueAt(const LightProfile& p, const std::optional<ProfilePlace>& place) {
  return place ? place->mix([&](size_t i, size_t j) { return p.at(i, j); }) : 0.0f;
}

void checkAscending(const std::vector<float>& angles, const std::string& what, const char* name) {
  if (angles.size() < 2) fail("{}: {} {} angles, must be two or more", what, angles.size(), name);
  for (size_t i = 0; i < angles.size(); ++i)
    if (!std::isfinite(angles[i]) || (i > 0 && !(angles[i] > angles[i - 1])))
      fail("{}: {} angle {} is {}, they must be numbers that ascend", what, name, i, angles[i]);
}

}  // namespace

float profileAt(const LightProfile& p, float theta, float phi) {
  return valueAt(p, placeAt(p, theta, phi));
}

std::optional<ProfilePlace> placeTowards(const LightProfile& profile, Vec3 axis, Vec3 across,
                                         Vec3 w) {
  const float x = glm::dot(w, across), y = glm::dot(w, glm::cross(across, axis));
  const float theta = std::atan2(std::sqrt(x * x + y * y), glm::dot(w, axis));
  constexpr auto kDegrees = static_cast<float>(1 / kDegree);
  return placeAt(profile, kDegrees * theta, kDegrees * std::atan2(y, x));
}

float profileTowards(const LightProfile& profile, Vec3 axis, Vec3 across, Vec3 w) {
  return valueAt(profile, placeTowards(profile, axis, across, w));
}

// Differences of cosines and sines as products: narrow bands keep their digits.
double bandIntegral(double theta0, double theta1, double m0, double m1) {
  const double h = theta1 - theta0, middle = 0.5 * (theta0 + theta1), half = std::sin(0.5 * h);
  const double lessCosine = 2 * std::sin(middle) * half, moreSine = 2 * std::cos(middle) * half;
  const double ramp = moreSine - h * std::cos(theta1);
  return std::max(m0 * lessCosine + (m1 - m0) / h * ramp, 0.0);
}

double solidAngleOf(const LightProfile& p) {
  const auto aroundAxis = [&](size_t row) {
    double sum = 0;
    for (size_t j = 0; j + 1 < p.horizontal.size(); ++j)
      sum += 0.5 * (double(p.at(row, j)) + double(p.at(row, j + 1))) *
             (double(p.horizontal[j + 1]) - double(p.horizontal[j]));
    return kDegree * sum;
  };
  double sum = 0, above = aroundAxis(0);
  for (size_t i = 0; i + 1 < p.vertical.size(); ++i) {
    const double below = aroundAxis(i + 1);
    sum += bandIntegral(kDegree * double(p.vertical[i]), kDegree * double(p.vertical[i + 1]), above,
                        below);
    above = below;
  }
  return sum;
}

LightProfile mirrored(const LightProfile& profile) {
  LightProfile out = profile;
  const size_t columns = profile.horizontal.size();
  for (size_t j = 0; j < columns; ++j) {
    out.horizontal[j] = 360 - profile.horizontal[columns - 1 - j];
    for (size_t i = 0; i < profile.vertical.size(); ++i)
      out.values[i * columns + j] = profile.at(i, columns - 1 - j);
  }
  return out;
}

Vec3 acrossAxis(Vec3 axis, Vec3 v) {
  const Vec3 off = v - glm::dot(v, axis) * axis;
  const float length = glm::length(off);
  if (!(length > 1e-4f * glm::length(v))) return Basis(axis).tangent;
  // Once more: what was rounded along the axis is gone.
  const Vec3 unit = off / length;
  return glm::normalize(unit - glm::dot(unit, axis) * axis);
}

void checkProfile(const LightProfile& p, const std::string& what) {
  checkAscending(p.vertical, what, "vertical");
  checkAscending(p.horizontal, what, "horizontal");
  if (p.vertical.front() < 0 || p.vertical.back() > 180)
    fail("{}: its vertical angles leave the range of 0 to 180 degrees", what);
  if (p.horizontal.front() != 0 || p.horizontal.back() != 360)
    fail("{}: its horizontal angles do not go from 0 to 360 degrees", what);
  if (p.values.size() % p.horizontal.size() != 0 ||
      p.values.size() / p.horizontal.size() != p.vertical.size())
    fail("{}: {} values for {} times {} angles", what, p.values.size(), p.vertical.size(),
         p.horizontal.size());
  for (const float value : p.values)
    if (!(value >= 0 && value <= 1)) fail("{}: a value is {}, must be 0 to 1", what, value);
}

}  // namespace ninefold
