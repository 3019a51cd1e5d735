#include "common/gi/methods.h"

#include "common/base/error.h"
#include "common/gi/automatic/automatic.h"
#include "common/gi/bidirectional/bidirectional.h"
#include "common/gi/intersection_field/intersection_field.h"
#include "common/gi/photon_map/photon_map.h"
#include "common/gi/radiosity/radiosity.h"
#include "common/gi/reference/reference.h"
#include "common/gi/selective/selective.h"
#ifdef NINEFOLD_TEST_METHODS
#include "common/gi/state_check/state_check.h"
#endif

namespace ninefold {

namespace {

// method: of those that the switch below knows.
std::unique_ptr<const GiMethod> make(Method method, const Transport& t, const GiMethod* begun,
                                     const GiMethod* before) {
  switch (method) {
    case Method::instantRadiosity:
      return std::make_unique<const Radiosity>(t, dynamic_cast<const Radiosity*>(begun));
    case Method::pathTrace:
      return std::make_unique<const Reference>(t);
    case Method::bidirectional:
      return std::make_unique<const Bidirectional>(t, dynamic_cast<const Bidirectional*>(begun));
    case Method::photonMap:
      return std::make_unique<const PhotonMap>(t, dynamic_cast<const PhotonMap*>(begun));
    case Method::selective:
      return std::make_unique<const Selective>(t, dynamic_cast<const Selective*>(begun),
                                               dynamic_cast<const Selective*>(before));
    case Method::intersectionField:
      return std::make_unique<const IntersectionField>(
          t, dynamic_cast<const IntersectionField*>(begun),
          dynamic_cast<const IntersectionField*>(before));
    case Method::automatic: {
      const auto* known = dynamic_cast<const Automatic*>(begun);
      Automatic::Tried tried;
      for (size_t i = 0; i < tried.size(); ++i)
        tried[i] = make(kTried[i], t, known != nullptr ? known->tried(i) : nullptr, nullptr);
      return std::make_unique<const Automatic>(t, std::move(tried));
    }
#ifdef NINEFOLD_TEST_METHODS
    case Method::stateCheck:
      return std::make_unique<const StateCheck>(t);
#endif
  }
  fail("method {} has no computing half", static_cast<int>(method));
}

}  // namespace

std::unique_ptr<const GiMethod> makeMethod(const Transport& t, const GiMethod* begun,
                                           const GiMethod* before) {
  return make(t.settings.method, t, begun, before);
}

}  // namespace ninefold
