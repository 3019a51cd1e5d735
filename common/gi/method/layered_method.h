// layered_method.h: a method that answers one query: what is E at these points? Eye paths and their
// layers are the same for all such methods (layer_receivers.h); this joins the two.
//
// Threads, owner, errors: as method.h says.
#pragma once

#include <vector>

#include "common/gi/eye/layer_receivers.h"
#include "common/gi/eye/receiver_samples.h"
#include "common/gi/method/method.h"

namespace ninefold {

struct LayeredScratch : Scratch {
  LayerReceivers layers;
};

class LayeredMethod : public GiMethod {
 public:
  using GiMethod::GiMethod;

  void render(const View& view, const Task& task, const FrameLight& light, Scratch& scratch,
              TileResult& out) const final;

 protected:
  // Adds E [W/m^2] to the receivers. pathVertices: number of D vertices from the eye to these
  // receivers, which are counted. caustic: if not null, one value a receiver, to which the part of
  // E that came by way of S is added. `scratch`: one that makeScratch made.
  virtual void query(const FrameLight& light, const ReceiverSamples& samples, int pathVertices,
                     LayeredScratch& scratch, Receivers& receivers,
                     std::vector<Irradiance>* caustic, RayCounts& rays) const = 0;
};

}  // namespace ninefold
