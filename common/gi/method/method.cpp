#include "common/gi/method/method.h"

#include "common/base/error.h"

namespace ninefold {

StepResult GiMethod::step(const StatePages&, const StepKey&, uint32_t, const View&) const {
  fail("a step of a method that has no state");
}

std::shared_ptr<const MethodState> GiMethod::digest(const StatePages&, const MethodState*) const {
  return nullptr;
}

}  // namespace ninefold
