#include "master/web/viewer_book.h"

#include <algorithm>

namespace ninefold {

void ViewerBook::join(ViewerId id) {
  all_.push_back(id);
  if (!inControl_) inControl_ = id;
}

void ViewerBook::leave(ViewerId id) {
  std::erase(all_, id);
  std::erase(asking_, id);
  if (isInControl(id)) pass();
}

void ViewerBook::ask(ViewerId id) {
  const bool isNew = std::ranges::find(asking_, id) == asking_.end();
  if (isNew && !isInControl(id)) asking_.push_back(id);
}

void ViewerBook::give(ViewerId id) {
  if (isInControl(id) && !asking_.empty()) pass();
}

void ViewerBook::pass() {
  inControl_.reset();
  if (!asking_.empty()) {
    inControl_ = asking_.front();
    asking_.erase(asking_.begin());
  } else if (!all_.empty()) {
    inControl_ = all_.front();
  }
}

}  // namespace ninefold
