// receivers.h: the points x of a task that gather irradiance, planar, so that sixteen go to one VPL
// at once. One array a component; capacity is kept between tasks. Threads: one thread's scratch.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/tracing/surface.h"

namespace ninefold {

// One receiver as the eye path made it.
struct Receiver {
  Vec3 position{0};
  Vec3 ng{0}, ns{0};   // geometric and shading normal, turned to where the path came from
  Vec3 origin{0};      // where shadow rays start: position moved off the surface along ng
  uint32_t pixel = 0;  // names the pixel in the whole image: x + width * y
  float gain = 1;      // 1 / probability of the lobe choices behind it; E is multiplied by it
};

class Receivers {
 public:
  void clear() {
    for (auto* plane : planes()) plane->clear();
    pixel.clear();
  }
  void add(const Receiver& r) {
    const float values[] = {
        r.position.x, r.position.y, r.position.z, r.ng.x,     r.ng.y, r.ng.z, r.ns.x, r.ns.y,
        r.ns.z,       r.origin.x,   r.origin.y,   r.origin.z, r.gain, 0.0f,   0.0f,   0.0f};
    size_t i = 0;
    for (auto* plane : planes()) plane->push_back(values[i++]);
    pixel.push_back(r.pixel);
  }
  size_t size() const { return pixel.size(); }
  Vec3 position(size_t i) const { return Vec3(px[i], py[i], pz[i]); }
  Vec3 ng(size_t i) const { return Vec3(gx[i], gy[i], gz[i]); }
  Vec3 ns(size_t i) const { return Vec3(sx[i], sy[i], sz[i]); }
  Vec3 origin(size_t i) const { return Vec3(ox[i], oy[i], oz[i]); }
  Vec3 irradiance(size_t i) const { return Vec3(er[i], eg[i], eb[i]); }
  void addIrradiance(size_t i, Vec3 e) { er[i] += e.x, eg[i] += e.y, eb[i] += e.z; }

  // Fills up to a multiple of sixteen with copies of the last receiver; size() stays.
  void pad(size_t lanes) {
    if (pixel.empty()) return;
    const size_t wanted = (size() + lanes - 1) / lanes * lanes;
    for (auto* plane : planes()) plane->resize(wanted, plane->back());
  }

  std::vector<float> px, py, pz;  // position [m]
  std::vector<float> gx, gy, gz;  // geometric normal
  std::vector<float> sx, sy, sz;  // shading normal
  std::vector<float> ox, oy, oz;  // origin of shadow rays [m]
  std::vector<float> gain;
  std::vector<float> er, eg, eb;  // gathered irradiance [W/m^2], without gain
  std::vector<uint32_t> pixel;

 private:
  std::array<std::vector<float>*, 16> planes() {
    return {&px, &py, &pz, &gx, &gy, &gz, &sx, &sy, &sz, &ox, &oy, &oz, &gain, &er, &eg, &eb};
  }
};

}  // namespace ninefold
