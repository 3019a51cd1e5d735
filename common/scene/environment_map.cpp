#include "common/scene/environment_map.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/sampling/distribution.h"

namespace ninefold {
namespace {

const Vec3 kUp(0, 1, 0);

EnvironmentPicture checked(EnvironmentPicture p) {
  if (p.width < 2 || p.width > kWidestEnvironment || p.width != 2 * p.height)
    fail("an environment of {} x {} texels, it must be twice as wide as high and at most {} wide",
         p.width, p.height, kWidestEnvironment);
  if (p.texels.size() != static_cast<size_t>(p.width) * static_cast<size_t>(p.height))
    fail("an environment of {} texels, {} x {} are declared", p.texels.size(), p.width, p.height);
  for (const Vec3& t : p.texels)
    for (int c = 0; c < 3; ++c)
      if (!(t[c] >= 0 && t[c] <= kBrightestTexel))
        fail("a texel of the environment is {}, must be 0 to {:g}", t[c], kBrightestTexel);
  if (!std::isfinite(p.rotation)) fail("the environment's rotation is no finite number");
  return p;
}

Vec3 startOf(const EnvironmentPicture& p) {
  const double azimuth = (1.0 / p.width - 1) * double{kPi} - double{p.rotation};
  return Vec3(DVec3(std::cos(azimuth), 0, std::sin(azimuth)));
}

double grey(Vec3 v) { return (double{v.x} + double{v.y} + double{v.z}) / 3; }

// Texels lie in the table below a row for the pole; its last column is the first again.
size_t texelAt(const EnvironmentPicture& p, size_t row, size_t column) {
  const auto last = static_cast<size_t>(p.height) - 1, width = static_cast<size_t>(p.width);
  const size_t y = std::min(row == 0 ? 0 : row - 1, last);
  return y * width + column % width;
}

LightProfile emptyTable(const EnvironmentPicture& p) {
  LightProfile table;
  table.vertical.push_back(0);
  for (int i = 0; i < p.height; ++i)
    table.vertical.push_back(static_cast<float>((i + 0.5) * 180 / p.height));
  table.vertical.push_back(180);
  for (int j = 0; j <= p.width; ++j)
    table.horizontal.push_back(static_cast<float>(360.0 * j / p.width));
  return table;
}

// A row's share of the sphere, if values go straight from row to row.
double shareOfRow(const LightProfile& table, size_t row) {
  const auto theta = [&](size_t i) { return kDegree * double(table.vertical[i]); };
  double share = 0;
  if (row > 0) share += bandIntegral(theta(row - 1), theta(row), 0, 1);
  if (row + 1 < table.vertical.size()) share += bandIntegral(theta(row), theta(row + 1), 1, 0);
  return share / 2;
}

Vec3 meanOf(const EnvironmentPicture& p) {
  const LightProfile table = emptyTable(p);
  DVec3 sum(0);
  for (size_t row = 0; row < table.vertical.size(); ++row) {
    DVec3 ofRow(0);
    for (size_t j = 0; j < static_cast<size_t>(p.width); ++j)
      ofRow += DVec3(p.texels[texelAt(p, row, j)]);
    sum += shareOfRow(table, row) / p.width * ofRow;
  }
  return Vec3(sum);
}

LightProfile weightsOf(const EnvironmentPicture& p, Vec3 mean) {
  LightProfile table = emptyTable(p);
  const double scale = grey(mean) > 0 ? (1 - kAlike) / grey(mean) : 0;
  double largest = 0;
  for (const Vec3& texel : p.texels) largest = std::max(largest, scale * grey(texel) + kAlike);
  table.values.reserve(table.vertical.size() * table.horizontal.size());
  for (size_t i = 0; i < table.vertical.size(); ++i)
    for (size_t j = 0; j < table.horizontal.size(); ++j)
      table.values.push_back(
          static_cast<float>((scale * grey(p.texels[texelAt(p, i, j)]) + kAlike) / largest));
  return table;
}

}  // namespace

EnvironmentMap::EnvironmentMap(EnvironmentPicture picture)
    : picture_(checked(std::move(picture))),
      across_(startOf(picture_)),
      mean_(meanOf(picture_)),
      weights_(weightsOf(picture_, mean_)),
      sampling_(weights_) {}

Vec3 EnvironmentMap::towards(Vec3 w) const {
  const auto place = placeTowards(weights_, kUp, across_, w);
  if (!place) return Vec3(0);
  return place->mix([&](size_t i, size_t j) { return picture_.texels[texelAt(picture_, i, j)]; });
}

float EnvironmentMap::pdf(Vec3 w) const { return sampling_.pdf(kUp, across_, w); }

Vec3 EnvironmentMap::sample(Vec2 u) const { return sampling_.sample(kUp, across_, u); }

}  // namespace ninefold
