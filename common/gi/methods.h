// methods.h: the one place that knows which computing half belongs to which method.
//
// Threads: pure function.   Errors: throws TooLarge for a scene that a method has no room for.
#pragma once

#include "common/gi/method/method.h"

namespace ninefold {

// The method of transport.settings.method. `begun`: the same method in the scene that a gesture
// began with; null at rest. `before`: a method in an earlier scene, or null: it may save work.
std::unique_ptr<const GiMethod> makeMethod(const Transport& transport, const GiMethod* begun,
                                           const GiMethod* before = nullptr);

}  // namespace ninefold
