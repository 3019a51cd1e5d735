// receivers.h: the points x of a task that gather irradiance. Planar, one array a component, so
// that sixteen go to one VPL at once. Capacity is kept between tasks.
// Threads: one thread's scratch.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "common/gi/light/shading.h"

namespace ninefold {

// One receiver as the eye path made it.
struct Receiver {
  Vec3 position{0};
  Vec3 ng{0}, ns{0};   // geometric and shading normal, turned to where the path came from
  Vec3 origin{0};      // where shadow rays start: position moved off the surface along ng
  uint32_t pixel = 0;  // names the pixel in the whole image: x + width * y
  float gain = 1;      // 1 / probability of the lobe choices behind it; E is multiplied by it
  int absorber = -1;   // material of the absorbing solid that it lies in; -1 = none
  uint32_t object = 0, triangle = 0;  // where it lies: instance, and triangle of its mesh ...
  float u = 0, v = 0;                 // ... at barycentrics of the second and third corner
};

// A diffuse point as it gathers light. pixel, absorber: as above.
inline Receiver receiverAt(const ShadingPoint& x, uint32_t pixel, int absorber) {
  Receiver r;
  r.position = x.surface.position, r.ng = x.ng, r.ns = x.ns;
  r.origin = offsetOrigin(x.surface, x.ng);
  r.pixel = pixel, r.absorber = absorber;
  r.object = x.surface.instance, r.triangle = x.surface.triangle;
  r.u = x.surface.u, r.v = x.surface.v;
  return r;
}

class Receivers {
 public:
  void clear() { size_ = 0, absorbs_ = false; }
  void add(const Receiver& r) {
    if (size_ == pixel.size()) grow();
    const size_t i = size_++;
    px[i] = r.position.x, py[i] = r.position.y, pz[i] = r.position.z;
    gx[i] = r.ng.x, gy[i] = r.ng.y, gz[i] = r.ng.z;
    sx[i] = r.ns.x, sy[i] = r.ns.y, sz[i] = r.ns.z;
    ox[i] = r.origin.x, oy[i] = r.origin.y, oz[i] = r.origin.z;
    gain[i] = r.gain, er[i] = 0, eg[i] = 0, eb[i] = 0;
    pixel[i] = r.pixel, absorber[i] = r.absorber;
    object[i] = r.object, triangle[i] = r.triangle, u[i] = r.u, v[i] = r.v;
    absorbs_ |= r.absorber >= 0;
  }
  size_t size() const { return size_; }
  bool absorbs() const { return absorbs_; }  // some lie in an absorbing solid
  Vec3 position(size_t i) const { return Vec3(px[i], py[i], pz[i]); }
  Vec3 ng(size_t i) const { return Vec3(gx[i], gy[i], gz[i]); }
  Vec3 ns(size_t i) const { return Vec3(sx[i], sy[i], sz[i]); }
  Vec3 origin(size_t i) const { return Vec3(ox[i], oy[i], oz[i]); }
  Vec3 irradiance(size_t i) const { return Vec3(er[i], eg[i], eb[i]); }
  void addIrradiance(size_t i, Vec3 e) { er[i] += e.x, eg[i] += e.y, eb[i] += e.z; }

  void clearIrradiance() {
    for (auto* plane : {&er, &eg, &eb}) std::fill_n(plane->begin(), size_, 0.0f);
  }

  // Receiver i without irradiance.
  Receiver at(size_t i) const {
    return {position(i), ng(i),     ns(i),       origin(i), pixel[i], gain[i],
            absorber[i], object[i], triangle[i], u[i],      v[i]};
  }

  // Copies the last receiver up to the next multiple of sixteen; size() stays.
  void pad() {
    for (size_t i = size_; i % kRoom != 0; ++i)
      for (auto* plane : planes()) (*plane)[i] = (*plane)[i - 1];
  }

  // Longer than size(): there is room for more, and the length is a multiple of sixteen.
  std::vector<float> px, py, pz;  // position [m]
  std::vector<float> gx, gy, gz;  // geometric normal
  std::vector<float> sx, sy, sz;  // shading normal
  std::vector<float> ox, oy, oz;  // origin of shadow rays [m]
  std::vector<float> gain;
  std::vector<float> er, eg, eb;  // gathered irradiance [W/m^2], without gain
  std::vector<uint32_t> pixel;
  std::vector<int32_t> absorber;
  std::vector<uint32_t> object, triangle;  // as above
  std::vector<float> u, v;

 private:
  static constexpr size_t kRoom = 16;  // lanes of a packet

  void grow() {
    const size_t room = std::max<size_t>(64 * kRoom, 2 * pixel.size());
    for (auto* plane : planes()) plane->resize(room);
    pixel.resize(room), absorber.resize(room);
    object.resize(room), triangle.resize(room);
  }
  std::array<std::vector<float>*, 18> planes() {
    return {&px, &py, &pz, &gx,   &gy, &gz, &sx, &sy, &sz,
            &ox, &oy, &oz, &gain, &er, &eg, &eb, &u,  &v};
  }

  size_t size_ = 0;
  bool absorbs_ = false;
};

}  // namespace ninefold
