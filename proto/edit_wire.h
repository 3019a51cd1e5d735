// edit_wire.h: SceneEdit as a protobuf message. Internal to messages_decode/encode. What exists in
// which scene is not known here: scene/edit.h checks that.
// Errors: fromWire throws Error on numbers that no scene can have. Threads: pure.
#pragma once

#include "common/scene/edit.h"
#include "proto/messages.pb.h"

namespace ninefold {

void toWire(const SceneEdit& edit, pb::Edit& out);
SceneEdit fromWire(const pb::Edit& in);

}  // namespace ninefold
