// The sky of Preetham et al. Expected values: the zenith by the paper's polynomials, worked out by
// hand here; the sun's irradiance; symmetry; what the picture sums up to.
#include "common/scene/sky_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ninefold {
namespace {

constexpr double kExactPi = 3.14159265358979323846;

double luminanceOf(DVec3 rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

// T = 3, sun at 45 degrees: chi = (4/9 - 3/120)(pi/2) = 0.658862,
// Yz = (4.0453*3 - 4.9710) tan chi - 0.2155*3 + 2.4192 = 7.3204 kcd/m^2.
TEST(SkyModel, TheZenithIsThePapers) {
  const double chi = (4.0 / 9 - 3.0 / 120) * kExactPi / 2;
  const double Y = (4.0453 * 3 - 4.9710) * std::tan(chi) - 0.2155 * 3 + 2.4192;
  const DVec3 zenith = skyTowards({.elevation = 45, .turbidity = 3}, DVec3(0, 1, 0));
  EXPECT_NEAR(luminanceOf(zenith), 1000 * Y / 683, 1e-3 * Y);
  EXPECT_NEAR(Y, 7.3204, 1e-4);
  EXPECT_GT(zenith.z, 1.5 * zenith.x) << "blue";
}

TEST(SkyModel, IsBrightestAroundTheSun) {
  const SkyModel sky{.azimuth = 90, .elevation = 30, .turbidity = 4};
  const DVec3 sun = sunOf(sky);
  EXPECT_NEAR(sun.x, std::cos(kExactPi / 6), 1e-12) << "east is +x";
  EXPECT_NEAR(sun.y, 0.5, 1e-12);
  EXPECT_NEAR(sun.z, 0, 1e-12);
  EXPECT_NEAR(sunOf({.azimuth = 0, .elevation = 0}).z, -1, 1e-12) << "north is -z";
  const double near = luminanceOf(skyTowards(sky, sun));
  for (double angle = 0.2; angle < 1.2; angle += 0.2) {
    const DVec3 one = glm::normalize(sun + DVec3(0, 0, angle)), other(one.x, one.y, -one.z);
    EXPECT_LT(luminanceOf(skyTowards(sky, one)), near);
    EXPECT_NEAR(luminanceOf(skyTowards(sky, one)), luminanceOf(skyTowards(sky, other)), 1e-9);
  }
}

// At the zenith m = 1/(1 + 0.15 * 93.885^-1.253) = 0.9995; green of T = 2: beta = 0.0463,
// depth 0.008735 * 0.549^-4.08 + 0.0463 * 0.549^-1.3 = 0.1006 + 0.1009.
TEST(SkyModel, TheSunIsReddenedByTheAir) {
  const DVec3 high = sunlight({.elevation = 90, .turbidity = 2});
  EXPECT_NEAR(high.y, 127500.0 / 683 * std::exp(-0.9995 * (0.1006 + 0.1009)), 0.3);
  DVec3 before = high;
  for (const double elevation : {60.0, 30.0, 10.0, 2.0, 0.0}) {
    const DVec3 E = sunlight({.elevation = elevation, .turbidity = 2});
    EXPECT_GT(E.x, E.y);
    EXPECT_GT(E.y, E.z);
    EXPECT_LT(E.y, before.y);
    before = E;
  }
  EXPECT_LT(sunlight({.elevation = 45, .turbidity = 6}).y,
            sunlight({.elevation = 45, .turbidity = 2}).y);
}

// The picture less its sky is the sun: its irradiance across its light, by texels' solid angles.
TEST(SkyModel, ThePictureHoldsTheSunsLight) {
  for (const double elevation : {0.3, 20.0, 55.0, 90.0}) {
    const SkyModel sky{.azimuth = 30, .elevation = elevation, .turbidity = 3};
    const EnvironmentPicture picture = skyPicture(sky);
    ASSERT_EQ(picture.width, kSkyWidth);
    const DVec3 sun = sunOf(sky);
    DVec3 found(0);
    const int h = picture.height, w = picture.width;
    for (int y = 0; y < h; ++y) {
      const double omega =
          2 * kExactPi / w * (std::cos(kExactPi * y / h) - std::cos(kExactPi * (y + 1) / h));
      for (int x = 0; x < w; ++x) {
        const double theta = kExactPi * (y + 0.5) / h, phi = 2 * kExactPi * ((x + 0.5) / w - 0.5);
        const DVec3 d(std::sin(theta) * std::cos(phi), std::cos(theta),
                      std::sin(theta) * std::sin(phi));
        if (glm::dot(d, sun) < std::cos(0.02)) continue;
        const DVec3 ground = DVec3(picture.texels.back());
        const DVec3 behind = y < h / 2 ? skyTowards(sky, d) : ground;
        found += omega * (DVec3(picture.texels[static_cast<size_t>(y * w + x)]) - behind);
      }
    }
    const DVec3 E = sunlight(sky);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], E[c], 2e-3 * E[c]) << elevation;
  }
}

TEST(SkyModel, EverySkyIsAPicture) {
  for (const double elevation : {0.0, 90.0})
    for (const double turbidity : {2.0, 10.0})
      EXPECT_NO_THROW(EnvironmentMap(skyPicture({.elevation = elevation, .turbidity = turbidity})));
}

}  // namespace
}  // namespace ninefold
