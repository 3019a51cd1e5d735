// edit_messages.h: an edit cut into messages that are not too long.
// Threads: pure function.   Errors: none.   Proved: tests/proto/messages_test.cpp.
#pragma once

#include "proto/messages.h"

namespace ninefold {

// At least one. All but the last say that more follows.
std::vector<msg::Edit> editMessages(uint32_t version, const SceneEdit& edit, bool moving);

}  // namespace ninefold
