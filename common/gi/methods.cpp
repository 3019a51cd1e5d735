#include "common/gi/methods.h"

#include "common/base/error.h"
#include "common/gi/bidirectional/bidirectional.h"
#include "common/gi/photon_map/photon_map.h"
#include "common/gi/radiosity/radiosity.h"
#include "common/gi/reference/reference.h"
#ifdef NINEFOLD_TEST_METHODS
#include "common/gi/state_check/state_check.h"
#endif

namespace ninefold {

std::unique_ptr<const GiMethod> makeMethod(const Transport& t, const GiMethod* begun) {
  switch (t.settings.method) {
    case Method::instantRadiosity:
      return std::make_unique<const Radiosity>(t, dynamic_cast<const Radiosity*>(begun));
    case Method::pathTrace:
      return std::make_unique<const Reference>(t);
    case Method::bidirectional:
      return std::make_unique<const Bidirectional>(t, dynamic_cast<const Bidirectional*>(begun));
    case Method::photonMap:
      return std::make_unique<const PhotonMap>(t, dynamic_cast<const PhotonMap*>(begun));
#ifdef NINEFOLD_TEST_METHODS
    case Method::stateCheck:
      return std::make_unique<const StateCheck>(t);
#endif
  }
  fail("method {} has no computing half", static_cast<int>(t.settings.method));
}

}  // namespace ninefold
