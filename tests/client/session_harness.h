// session_harness.h: a client session with a clock of its own and a look at what it asks for.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "client/session.h"

namespace ninefold {

class SessionHarness {
 public:
  explicit SessionHarness(bool reconnect = true) : session(options(reconnect), now) {}

  static SessionOptions options(bool reconnect) {
    SessionOptions o;
    o.hello.name = "pc2";
    o.hello.isa = "avx2";
    o.hello.probeClass = "0123456789abcdef";
    o.master = "10.0.0.1:4700";
    o.reconnect = reconnect;
    return o;
  }
  static BlobInfo blob(uint8_t name, uint64_t rawBytes = 1000, BlobKind kind = BlobKind::rest) {
    BlobInfo info;
    info.hash[0] = name;
    info.rawBytes = rawBytes;
    info.kind = kind;
    return info;
  }
  static msg::Configure settings(uint32_t job = 1) {
    msg::Configure m{1, job, {}};
    m.settings.width = 96, m.settings.height = 72;
    return m;
  }

  // Takes the actions and gives back those of one kind.
  template <typename A>
  std::vector<A> take() {
    for (act::Action& action : session.takeActions()) actions.push_back(std::move(action));
    std::vector<A> found;
    std::erase_if(actions, [&](act::Action& action) {
      if (!std::holds_alternative<A>(action)) return false;
      found.push_back(std::move(std::get<A>(action)));
      return true;
    });
    return found;
  }
  // The messages of one type that were sent.
  template <typename M>
  std::vector<M> sent() {
    std::vector<M> found;
    for (act::Send& send : take<act::Send>())
      if (M* m = std::get_if<M>(&send.message))
        found.push_back(std::move(*m));
      else
        actions.push_back(std::move(send));
    return found;
  }
  void pass(Duration time) { session.tick(now += time); }
  void forget() { session.takeActions(), actions.clear(); }

  void connect() {
    session.tick(now);
    ASSERT_EQ(take<act::Connect>().size(), 1u);
    session.connected(now);
  }
  void welcome() {
    connect();
    session.received(msg::Welcome{7}, now);
  }
  // A scene of one blob that the cache has.
  void becomeReady() {
    welcome();
    session.received(msg::SceneOffer{1, {blob(1)}}, now);
    session.received(settings(), now);
    for (const auto& find : take<act::FindBlobs>()) session.blobsFound(find.load, {}, now);
    for (const auto& build : take<act::BuildScene>()) session.sceneBuilt(build.load, now);
    for (const auto& job : take<act::PrepareJob>())
      session.jobPrepared(job.load, job.line, job.jobVersion, now);
  }

  Time now = Time(std::chrono::hours(1));
  Session session;
  std::vector<act::Action> actions;
};

}  // namespace ninefold
