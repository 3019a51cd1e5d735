#include "common/scene/profile_sampling.h"

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

constexpr double kMiddle = 0x1p-25;  // of a cell of samples

// x in [0, 1] below which lies a share of the area under the line from a to b.
double invertLine(double a, double b, double share) {
  const double root = std::sqrt(std::max(a * a + share * (b * b - a * a), 0.0));
  return a + root > 0 ? std::min(share * (a + b) / (a + root), 1.0) : share;
}

// theta in the band below which lies `area`, for a value that goes straight from m0 to m1. Newton's
// steps, held in an interval that halves where they leave it.
double invertBand(double theta0, double theta1, double m0, double m1, double area) {
  constexpr int kSteps = 60;  // halves any interval down to the last digit
  const double slope = (m1 - m0) / (theta1 - theta0);
  double low = theta0, high = theta1, theta = 0.5 * (low + high);
  for (int i = 0; i < kSteps; ++i) {
    const double m = m0 + slope * (theta - theta0);
    const double off = theta > theta0 ? bandIntegral(theta0, theta, m0, m) - area : -area;
    (off > 0 ? high : low) = theta;
    const double density = m * std::sin(theta), step = density > 0 ? off / density : 0.0;
    if (density > 0 && std::abs(step) < 1e-9) break;  // a float's digits are less
    const double next = theta - step;
    theta = density > 0 && next > low && next < high ? next : 0.5 * (low + high);
  }
  return theta;
}

}  // namespace

ProfileSampling::ProfileSampling(const LightProfile& profile) : profile_(&profile) {
  const size_t rows = profile.vertical.size(), columns = profile.horizontal.size();
  around_.reserve(profile.values.size());
  below_.reserve(rows);
  for (size_t i = 0; i < rows; ++i) {
    around_.push_back(0);
    for (size_t j = 1; j < columns; ++j)
      around_.push_back(around_.back() +
                        0.5 * (double(profile.at(i, j - 1)) + double(profile.at(i, j))) *
                            (phi(j) - phi(j - 1)));
    const double band = i == 0 ? 0.0
                               : bandIntegral(theta(i - 1), theta(i), around(i - 1, columns - 1),
                                              around(i, columns - 1));
    below_.push_back(i == 0 ? 0.0 : below_.back() + band);
  }
}

double ProfileSampling::chooseTheta(double share, size_t& band) const {
  const double target = share * below_.back();
  // The first row that more lies below: the band above it is not empty.
  const auto end = std::upper_bound(below_.begin() + 1, below_.end() - 1, target);
  band = static_cast<size_t>(end - below_.begin()) - 1;
  const size_t last = profile_->horizontal.size() - 1;
  return invertBand(theta(band), theta(band + 1), around(band, last), around(band + 1, last),
                    target - below_[band]);
}

double ProfileSampling::choosePhi(double share, size_t band, double t) const {
  const auto mixed = [t](double a, double b) { return (1 - t) * a + t * b; };
  const auto upTo = [&](size_t j) { return mixed(around(band, j), around(band + 1, j)); };
  const auto value = [&](size_t j) {
    return mixed(double(profile_->at(band, j)), double(profile_->at(band + 1, j)));
  };
  size_t low = 0, high = profile_->horizontal.size() - 1;
  const double target = share * upTo(high);
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    (upTo(middle) <= target ? low : high) = middle;
  }
  const double area = upTo(high) - upTo(low);
  const double within = area > 0 ? std::clamp((target - upTo(low)) / area, 0.0, 1.0) : 0.5;
  const double x = invertLine(value(low), value(high), within);
  return phi(low) + x * (phi(high) - phi(low));
}

double ProfileSampling::shareOnAxisSide() const {
  constexpr double kHorizon = 90 * kDegree;
  const size_t last = profile_->horizontal.size() - 1;
  double sum = 0;
  for (size_t i = 0; i + 1 < below_.size() && theta(i) < kHorizon; ++i) {
    const double m0 = around(i, last), m1 = around(i + 1, last);
    const double t = std::min((kHorizon - theta(i)) / (theta(i + 1) - theta(i)), 1.0);
    sum += bandIntegral(theta(i), std::min(theta(i + 1), kHorizon), m0, m0 + t * (m1 - m0));
  }
  return solidAngle() > 0 ? sum / solidAngle() : 0.5;
}

Vec3 ProfileSampling::sample(Vec3 axis, Vec3 across, Vec2 u) const {
  size_t band = 0;
  const double down = chooseTheta(double(u.y) + kMiddle, band);
  const double t = (down - theta(band)) / (theta(band + 1) - theta(band));
  const double around = choosePhi(double(u.x) + kMiddle, band, t), sine = std::sin(down);
  const Vec3 w(DVec3(sine * std::cos(around), sine * std::sin(around), std::cos(down)));
  return w.x * across + w.y * glm::cross(across, axis) + w.z * axis;
}

float ProfileSampling::pdf(Vec3 axis, Vec3 across, Vec3 w) const {
  return profileTowards(*profile_, axis, across, w) / static_cast<float>(solidAngle());
}

}  // namespace ninefold
