#include "common/gi/photon_map/photon_world.h"

#include "common/scene/photon_scene.h"

namespace ninefold {

PhotonWorld::Simple::Simple(const Transport& seen, const PhotonWorld* begun)
    : scene(photonSceneOf(seen.scene)),
      tracer(scene, seen.tracer.isaName() == "avx512" ? Isa::avx512 : Isa::avx2),
      transport(tracer, seen.settings, begun != nullptr ? &begun->transport() : nullptr) {}

}  // namespace ninefold
