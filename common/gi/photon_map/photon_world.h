// photon_world.h: what the pool's photons meet, ready to be shot at. It is the scene itself, or the
// simpler one that came with it (common/scene/photon_scene.h).
//
// Owner:   of the simpler scene; refers to the Transport that it was made of.
// Threads: const after construction.   Errors: as Tracer.
#pragma once

#include <optional>

#include "common/gi/light/transport.h"

namespace ninefold {

class PhotonWorld {
 public:
  // `begun`: of the state that a gesture began with, or null.
  PhotonWorld(const Transport& seen, const PhotonWorld* begun) : seen_(seen) {
    if (!seen.scene.photonInstances.empty()) simple_.emplace(seen, begun);
  }
  const Transport& transport() const { return simple_ ? simple_->transport : seen_; }

 private:
  struct Simple {
    Simple(const Transport& seen, const PhotonWorld* begun);
    Scene scene;
    Tracer tracer;
    Transport transport;
  };
  const Transport& seen_;
  std::optional<Simple> simple_;
};

}  // namespace ninefold
