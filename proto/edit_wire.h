// edit_wire.h: SceneEdit as a protobuf message. Internal to messages_decode and messages_encode.
// Whether a scene has what an edit names is checked by scene/edit.h, not here.
// Errors: fromWire throws Error on numbers that no scene can have.   Threads: pure functions.
#pragma once

#include "common/scene/edit.h"
#include "proto/bytes.h"
#include "proto/messages.pb.h"

namespace ninefold {

void toWire(const SceneEdit& edit, pb::Edit& out);
// What shapes have behind the header.
Bytes shapeBytes(const std::vector<ShapeEdit>& shapes);
SceneEdit fromWire(const pb::Edit& in, ByteView payload);

}  // namespace ninefold
