// sky_model.h: a clear sky and its sun as a picture of all directions.
//
//   sky     L(theta, gamma) = Lz F(theta, gamma)/F(0, theta_s) for Y, x and y each
//           F(theta, gamma) = (1 + A e^(B/cos theta)) (1 + C e^(D gamma) + E cos^2 gamma)
//           theta from the zenith, gamma from the sun, theta_s: the sun's theta
//           A ... E and the zenith's Lz are polynomials of the turbidity T
//   sun     E(lambda) = E0 e^(-0.008735 lambda^-4.08 m) e^(-beta lambda^-1.3 m),   lambda [um]
//           beta = 0.04608 T - 0.04586,  m = 1/(cos theta_s + 0.15 (93.885 - theta_s)^-1.253)
//           (degrees), over a disk of 0.533 degrees. E0 = 127.5 klx, white. lambda: 0.611, 0.549
//           and 0.464 um, the dominant ones of Rec. 709. Ozone and vapour are left out.
//   ground  below the horizon: Lambertian, of albedo 0.2, lit by both
//
// Luminance becomes radiance by 683 lm/W, as photometric lamps do (light_units.h). North is -z,
// east +x, up +y.
//
// Source:  Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight", 1999, with the
//          appendix's polynomials; Kasten and Young's air mass there.
// Fails:   near the horizon against the sun, and at turbidities of 10, the model is too bright.
// Proved:  tests/scene/sky_model_test.cpp.   Threads: pure.
// Errors:  parseSky throws UsageError; skyPicture none for what parseSky lets through.
#pragma once

#include <string>

#include "common/scene/environment_map.h"

namespace ninefold {

struct SkyModel {
  double azimuth = 180;   // of the sun [degrees], clockwise from north for who looks down
  double elevation = 45;  // [degrees], 0 to 90
  double turbidity = 3;   // 2 (very clear) to 10 (hazy)
};

inline constexpr int kSkyWidth = 2048;

// AZIMUTH:ELEVATION[:TURBIDITY]
SkyModel parseSky(const std::string& value);

// Towards the sun.
DVec3 sunOf(const SkyModel& sky);
// Irradiance of the sun across its light [W/m^2].
DVec3 sunlight(const SkyModel& sky);
// Radiance of the sky without its sun, unit w with w.y > 0 [W/(m^2 sr)].
DVec3 skyTowards(const SkyModel& sky, DVec3 w);

EnvironmentPicture skyPicture(const SkyModel& sky);

}  // namespace ninefold
