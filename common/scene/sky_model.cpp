#include "common/scene/sky_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/command_line.h"
#include "common/image/image.h"
#include "common/scene/light_units.h"

namespace ninefold {
namespace {

constexpr double kSunConstant = 127500;          // E0 [lx]
constexpr double kSunRadius = 0.2665 * kDegree;  // [rad]
constexpr double kGround = 0.2;                  // albedo
constexpr double kLeastCosine = 1e-3;            // at the horizon F has no value

double towardsZenith(const SkyModel& sky) { return (90 - sky.elevation) * kDegree; }

// One of Y, x, y over the sky: F by its coefficients, and the zenith's value.
struct Perez {
  double a, b, c, d, e, zenith;
  double f(double cosTheta, double gamma) const {
    const double cosGamma = std::cos(gamma);
    return (1 + a * std::exp(b / std::max(cosTheta, kLeastCosine))) *
           (1 + c * std::exp(d * gamma) + e * cosGamma * cosGamma);
  }
};

// (T^2, T, 1) M (s^3, s^2, s, 1)
double chromaticity(double T, double s, const double (&m)[3][4]) {
  double sum = 0;
  for (const double* row : m) sum = sum * T + ((row[0] * s + row[1]) * s + row[2]) * s + row[3];
  return sum;
}

Perez luminance(double T, double s) {
  const double chi = (4.0 / 9 - T / 120) * (double{kPi} - 2 * s);
  const double kcd = (4.0453 * T - 4.9710) * std::tan(chi) - 0.2155 * T + 2.4192;
  return {0.1787 * T - 1.4630, -0.3554 * T + 0.4275, -0.0227 * T + 5.3251,
          0.1206 * T - 2.5771, -0.0670 * T + 0.3703, 1000 * kcd};
}

Perez chromaticityX(double T, double s) {
  constexpr double kZenith[3][4] = {{0.00166, -0.00375, 0.00209, 0},
                                    {-0.02903, 0.06377, -0.03202, 0.00394},
                                    {0.11693, -0.21196, 0.06052, 0.25886}};
  return {-0.0193 * T - 0.2592, -0.0665 * T + 0.0008, -0.0004 * T + 0.2125,
          -0.0641 * T - 0.8989, -0.0033 * T + 0.0452, chromaticity(T, s, kZenith)};
}

Perez chromaticityY(double T, double s) {
  constexpr double kZenith[3][4] = {{0.00275, -0.00610, 0.00317, 0},
                                    {-0.04214, 0.08970, -0.04153, 0.00516},
                                    {0.15346, -0.26756, 0.06670, 0.26688}};
  return {-0.0167 * T - 0.2608, -0.0950 * T + 0.0092, -0.0079 * T + 0.2102,
          -0.0441 * T - 1.6537, -0.0109 * T + 0.0529, chromaticity(T, s, kZenith)};
}

// CIE Y, x, y to linear Rec. 709; colours beyond it are held to it.
DVec3 rgbOf(double Y, double x, double y) {
  const double X = x / y * Y, Z = (1 - x - y) / y * Y;
  return glm::max(DVec3(3.2404542 * X - 1.5371385 * Y - 0.4985314 * Z,
                        -0.9692660 * X + 1.8760108 * Y + 0.0415560 * Z,
                        0.0556434 * X - 0.2040259 * Y + 1.0572252 * Z),
                  DVec3(0));
}

class Sky {
 public:
  explicit Sky(const SkyModel& sky)
      : sun_(sunOf(sky)),
        s_(towardsZenith(sky)),
        Y_(luminance(sky.turbidity, s_)),
        x_(chromaticityX(sky.turbidity, s_)),
        y_(chromaticityY(sky.turbidity, s_)) {}

  DVec3 towards(DVec3 w) const {
    const double gamma = std::acos(std::clamp(glm::dot(w, sun_), -1.0, 1.0));
    const auto value = [&](const Perez& p) { return p.zenith * p.f(w.y, gamma) / p.f(1, s_); };
    return rgbOf(std::max(value(Y_), 0.0), value(x_), value(y_)) / kLumensPerWatt;
  }

 private:
  const DVec3 sun_;
  const double s_;
  const Perez Y_, x_, y_;
};

// Texels of a picture, by row and column.
struct Grid {
  int width = kSkyWidth, height = kSkyWidth / 2;
  DVec3 towards(double x, double y) const {
    const double theta = double{kPi} * y / height;
    const double azimuth = 2 * double{kPi} * (x / width - 0.5);
    return {std::sin(theta) * std::cos(azimuth), std::cos(theta),
            std::sin(theta) * std::sin(azimuth)};
  }
  double solidAngle(int y) const {
    const double step = double{kPi} / height;
    return 2 * double{kPi} / width * (std::cos(step * y) - std::cos(step * (y + 1)));
  }
};

// Share of a texel that the sun's disk covers.
double sunIn(const Grid& grid, DVec3 sun, int x, int y) {
  constexpr int kParts = 8;
  const double cosine = std::cos(kSunRadius);
  int inside = 0;
  for (int i = 0; i < kParts * kParts; ++i) {
    const double u = x + (i % kParts + 0.5) / kParts, v = y + (i / kParts + 0.5) / kParts;
    inside += glm::dot(grid.towards(u, v), sun) >= cosine ? 1 : 0;
  }
  return inside / double{kParts * kParts};
}

// Adds the disk, so that its irradiance is just E.
void addSun(const Grid& grid, DVec3 sun, DVec3 E, std::vector<Vec3>& texels) {
  const double row = std::acos(std::clamp(sun.y, -1.0, 1.0)) / double{kPi} * grid.height;
  const int reach = static_cast<int>(kSunRadius / double{kPi} * grid.height) + 2;
  const int first = std::max(static_cast<int>(row) - reach, 0);
  const int last = std::min(static_cast<int>(row) + reach, grid.height - 1);
  std::vector<std::pair<size_t, double>> disk;
  double solidAngle = 0;
  for (int y = first; y <= last; ++y)
    for (int x = 0; x < grid.width; ++x) {
      const double share = sunIn(grid, sun, x, y);
      if (share == 0) continue;
      disk.emplace_back(static_cast<size_t>(y * grid.width + x), share);
      solidAngle += share * grid.solidAngle(y);
    }
  for (const auto& [texel, share] : disk) texels[texel] += Vec3(share / solidAngle * E);
}

}  // namespace

SkyModel parseSky(const std::string& value) {
  SkyModel sky;
  try {
    const std::vector<double> n = parseNumbers("sky", value, ':');
    if (n.size() < 2 || n.size() > 3) failUsage("two or three numbers");
    sky.azimuth = checkRange("sky", n[0], -360.0, 360.0);
    sky.elevation = checkRange("sky", n[1], 0.0, 90.0);
    if (n.size() == 3) sky.turbidity = checkRange("sky", n[2], 2.0, 10.0);
  } catch (const UsageError&) {
    failUsage(
        "--sky {}: write AZIMUTH:ELEVATION[:TURBIDITY], azimuth -360 to 360, elevation 0 to 90, "
        "turbidity 2 to 10",
        value);
  }
  return sky;
}

DVec3 sunOf(const SkyModel& sky) {
  const double up = sky.elevation * kDegree, around = sky.azimuth * kDegree;
  return {std::cos(up) * std::sin(around), std::sin(up), -std::cos(up) * std::cos(around)};
}

DVec3 sunlight(const SkyModel& sky) {
  const double fromZenith = 90 - sky.elevation;
  const double m =
      1 / (std::cos(fromZenith * kDegree) + 0.15 * std::pow(93.885 - fromZenith, -1.253));
  const double beta = 0.04608 * sky.turbidity - 0.04586;
  DVec3 E;
  constexpr double kWavelengths[] = {0.611, 0.549, 0.464};  // [um]
  for (int c = 0; c < 3; ++c) {
    const double depth =
        0.008735 * std::pow(kWavelengths[c], -4.08) + beta * std::pow(kWavelengths[c], -1.3);
    E[c] = kSunConstant / kLumensPerWatt * std::exp(-depth * m);
  }
  return E;
}

DVec3 skyTowards(const SkyModel& sky, DVec3 w) { return Sky(sky).towards(w); }

EnvironmentPicture skyPicture(const SkyModel& model) {
  const Grid grid;
  EnvironmentPicture picture;
  picture.name = fmt::format("--sky {}:{}:{}", model.azimuth, model.elevation, model.turbidity);
  picture.width = grid.width, picture.height = grid.height;
  const Sky sky(model);
  const DVec3 sun = sunOf(model), beam = sunlight(model);
  DVec3 down = std::max(sun.y, 0.0) * beam;  // irradiance of the ground
  for (int y = 0; y < grid.height / 2; ++y)
    for (int x = 0; x < grid.width; ++x) {
      const DVec3 w = grid.towards(x + 0.5, y + 0.5), L = sky.towards(w);
      picture.texels.emplace_back(L);
      down += grid.solidAngle(y) * w.y * L;
    }
  const Vec3 ground(kGround / double{kPi} * down);
  picture.texels.resize(pixelCount(grid.width, grid.height), ground);
  addSun(grid, sun, beam, picture.texels);
  return picture;
}

}  // namespace ninefold
