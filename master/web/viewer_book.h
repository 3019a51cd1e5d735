// viewer_book.h: who looks on, and who of them is in control: the first who came, until they hand
// it over to who has asked for longest, or leave; then who has asked, else who came next. Pure.
// Threads: plain value.   Errors: none.   Proved: tests/web/viewer_book_test.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace ninefold {

using ViewerId = uint32_t;

class ViewerBook {
 public:
  void join(ViewerId id);
  void leave(ViewerId id);
  void ask(ViewerId id);
  void give(ViewerId id);  // nothing, unless `id` is in control and somebody has asked

  std::optional<ViewerId> inControl() const { return inControl_; }
  bool isInControl(ViewerId id) const { return inControl_ == id; }
  const std::vector<ViewerId>& asking() const { return asking_; }  // longest first
  const std::vector<ViewerId>& all() const { return all_; }        // first come first

 private:
  void pass();

  std::vector<ViewerId> all_, asking_;
  std::optional<ViewerId> inControl_;
};

}  // namespace ninefold
