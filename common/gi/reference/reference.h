// reference.h: the path tracer as a method: whole radiance as U of the diffuse layer, which no
// filter touches. It has its own pixel loop and no light sets: it is independent, so a reference.
//
//   irradiance, caustic   E at the first hit, all of it or what came by way of S: pi times the
//                         radiance that a white matte surface there would send. They take paths of
//                         their own, only if asked for: the picture does not change.
//   reflectance           with the caustic plane, for whoever shows its share of the picture
//
// Threads, owner, errors: as method.h says.
#pragma once

#include "common/gi/method/method.h"

namespace ninefold {

class Reference final : public GiMethod {
 public:
  using GiMethod::GiMethod;

  std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                          std::span<const View> views,
                                          const MethodState* state) const override;
  void render(const View& view, const Task& task, const FrameLight& light, Scratch& scratch,
              TileResult& out) const override;
  std::unique_ptr<Scratch> makeScratch() const override;
};

}  // namespace ninefold
