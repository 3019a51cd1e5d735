// profile_sampling.h: directions in proportion to a light profile.
//
//   pdf(w) = f(w) / Omega   [1/sr]
//
// The map from the square is continuous, but where f is 0:
//   u.y  theta, whose density is sin(theta) times the row's integral over phi. Within a band that
//        is a straight line times a sine; its integral is inverted by halving and Newton's steps
//   u.x  phi, whose density at that theta is piecewise a straight line; inverted by a square root
//
// Symbols as in light_profile.h; here angles are radians.
//
// Proved:  tests/scene/light_profile_test.cpp (chi-square against f; mean of what is carried).
// Owner:   refers to the profile.   Threads: const.   Errors: none.
#pragma once

#include "common/scene/light_profile.h"

namespace ninefold {

class ProfileSampling {
 public:
  explicit ProfileSampling(const LightProfile& profile);

  double solidAngle() const { return below_.back(); }  // Omega [sr]
  // Share of the light that goes less than 90 degrees off the axis.
  double shareOnAxisSide() const;

  // Only if Omega > 0. axis, across: as profileTowards takes them. u in [0, 1)^2, multiples of
  // 2^-24, which stand for the middles of their cells.
  Vec3 sample(Vec3 axis, Vec3 across, Vec2 u) const;
  float pdf(Vec3 axis, Vec3 across, Vec3 w) const;

 private:
  double around(size_t row, size_t column) const {
    return around_[row * profile_->horizontal.size() + column];
  }
  double theta(size_t row) const { return kDegree * double(profile_->vertical[row]); }
  double phi(size_t column) const { return kDegree * double(profile_->horizontal[column]); }
  double chooseTheta(double share, size_t& band) const;
  double choosePhi(double share, size_t band, double t) const;

  const LightProfile* profile_;
  std::vector<double> below_;   // by row: integral of f over all smaller theta [sr]
  std::vector<double> around_;  // by row and column: integral over all smaller phi [rad]
};

}  // namespace ninefold
