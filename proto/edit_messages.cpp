#include "proto/edit_messages.h"

namespace ninefold {

std::vector<msg::Edit> editMessages(uint32_t version, const SceneEdit& edit, bool moving) {
  std::vector<msg::Edit> messages{{version, edit, moving, false}};
  messages[0].edit.shapes.clear();
  for (const ShapeEdit& shape : edit.shapes) {
    if (messages.back().edit.shapes.size() == kMaxShapePieces) {
      messages.back().more = true;
      messages.push_back({version, {}, moving, false});
    }
    messages.back().edit.shapes.push_back(shape);
  }
  return messages;
}

}  // namespace ninefold
