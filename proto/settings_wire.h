// settings_wire.h: Settings, FrameKey and StepKey as protobuf messages. Internal to messages_decode
// and messages_encode.
// Errors: fromWire throws Error that names what is out of range, unknown, missing or there twice.
// Threads: pure functions.
#pragma once

#include "common/scene/settings.h"
#include "proto/messages.pb.h"

namespace ninefold {

void toWire(const Settings& settings, pb::Settings& out);
Settings fromWire(const pb::Settings& in);

void toWire(const FrameKey& frame, pb::FrameKey& out);
FrameKey fromWire(const pb::FrameKey& in);

void toWire(const StepKey& step, pb::StepKey& out);
StepKey fromWire(const pb::StepKey& in);

}  // namespace ninefold
