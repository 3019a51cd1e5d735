// automatic.h: whichever of two methods finds the light of this scene and view sooner. The method's
// state is a small trial of both (scene/method_trial.h). All frames of its version are those of the
// method that it chose, bit for bit.
//
// While anything moves the latest choice stays. Each rest makes a new one, of nothing but scene,
// settings and view. The film begins anew then anyway, so that another choice does no harm.
//
// Proved:  tests/gi/automatic_test.cpp; tests/master/state_plan_test.cpp;
//          tests/cluster/same_bytes_test.py.
// Fails:   in motion sets are made for each view, as the bidirectional method needs them, though
//          those of instant radiosity would be good for all.
// Threads, owner, errors: as method.h says.
#pragma once

#include <array>

#include "common/gi/method/method.h"
#include "common/scene/method_trial.h"

namespace ninefold {

class Automatic final : public GiMethod {
 public:
  using Tried = std::array<std::unique_ptr<const GiMethod>, kTried.size()>;

  // tried: the methods of kTried, made of the same Transport.
  Automatic(const Transport& transport, Tried tried)
      : GiMethod(transport), tried_(std::move(tried)) {}

  const GiMethod* tried(size_t which) const { return tried_[which].get(); }

  // `state` may be null: nothing was tried, and the first method it is.
  std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                          std::span<const View> views,
                                          const MethodState* state) const override;
  void render(const View& view, const Task& task, const FrameLight& light, Scratch& scratch,
              TileResult& out) const override;
  std::unique_ptr<Scratch> makeScratch() const override;
  StepResult step(const StatePages& pages, const StepKey& step, uint32_t unit,
                  const View& view) const override;
  std::shared_ptr<const MethodState> digest(const StatePages& pages,
                                            const MethodState* before) const override;

 private:
  TrialUnit::Side trySide(size_t which, uint32_t unit, const View& view) const;

  const Tried tried_;
};

}  // namespace ninefold
