// layer_receivers.h: what a task's pixels ask of the light: the diffuse points at the ends of their
// eye paths, by layer.
//
//   layer radiance = reflectance * E + U,   reflectance = throughput rho/pi
//
// Everything but E is written here; E belongs to the method.
//
// Threads: one thread's working memory, kept between tasks.   Errors: none.
#pragma once

#include <array>
#include <vector>

#include "common/gi/eye/first_hits.h"
#include "common/gi/eye/receivers.h"

namespace ninefold {

class LayerReceivers {
 public:
  // Follows the eye paths of the task's pixels. Fills all planes of its result but E.
  void find(TaskContext& context);

  // The receivers of a layer; after find() without irradiance.
  Receivers& of(int layer) { return receivers_[static_cast<size_t>(layer)]; }

  // Writes the irradiance of a layer's receivers, each times its gain, to the result.
  void putIrradiance(TaskContext& context, int layer) const;
  // Writes the part of E that came by way of S: one value for each receiver of the diffuse layer.
  void putCaustic(TaskContext& context, const std::vector<Irradiance>& caustic) const;

 private:
  void add(TaskContext& context, int layer, const ShadingPoint& x, size_t pixel, int absorber,
           Reflectance throughput, float gain, float distance, uint16_t chain);
  void followLayer(TaskContext& context, const FirstHit& first, Lobe lobe, Reflectance through);
  void split(TaskContext& context, const FirstHit& first);

  std::array<Receivers, kLayers> receivers_;
  // Index in the task's rectangle of each receiver.
  std::array<std::vector<uint32_t>, kLayers> places_;
};

}  // namespace ninefold
