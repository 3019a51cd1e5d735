#include "master/web/web_desk.h"

#include "common/base/log.h"

namespace ninefold {
namespace {

// Where the pointer was in between matters to nobody.
bool replaces(const FromViewer& later, const FromViewer& earlier) {
  const auto* a = std::get_if<said::Event>(&later.what);
  const auto* b = std::get_if<said::Event>(&earlier.what);
  return a != nullptr && b != nullptr && later.viewer == earlier.viewer &&
         a->event.kind == WindowEvent::Kind::move && b->event.kind == WindowEvent::Kind::move;
}

}  // namespace

void WebDesk::refuse(const std::string& peer, const std::string& why) {
  ++refused;
  if (const auto line = lines.admit(fmt::format("browser at {}: {}", peer, why), Clock::now()))
    warnLine(*line);
}

void WebDesk::passOn() {
  const std::vector<FromViewer> heard = hub.takeHeard();
  if (heard.empty()) return;
  const std::lock_guard lock(mutex);
  for (const FromViewer& one : heard) {
    if (!inbox.empty() && replaces(one, inbox.back()))
      inbox.back() = one;
    else
      inbox.push_back(one);
  }
  arrived.notify_one();
  if (inbox.size() > kMostWaiting) fail("more messages than the session keeps up with");
}

void WebDesk::wakeAll() {
  for (const Open& one : open)
    if (one.wake) one.wake();
}

}  // namespace ninefold
