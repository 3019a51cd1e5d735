// client_session.h: the master's side of the protocol with one client, as a pure value: messages
// and the time go in, actions come out. No socket, thread or clock.
//
//   greeting (connected) -> syncing (has Welcome, scene and settings) -> ready -> over
//
// Deadlines: Hello within kHelloWithin; a Ping every second, and over when nothing at all came for
// kDeadAfter (longer while the scene is being sent, which may fill a slow line).
// Errors: none thrown; a peer that says something impossible is over, with a reason that names it.
// Use: call an event function, then carry takeActions() out in order; tick() every 100 ms or so.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/base/clock.h"
#include "master/scheduling/scheduler_types.h"
#include "master/serving/admission.h"
#include "master/serving/job_offer.h"
#include "master/serving/state_keeper.h"

namespace ninefold {

namespace todo {  // what the server does for a session

struct Send {
  Message message;
};
struct Warn {
  std::string line;
};
struct Join {             // ready to render
  uint32_t job = 0;       // the first that it can do; it can do all later ones
  Duration sceneTime{0};  // that it took to build the scene, or a little less
};
struct Heard {};
struct RoundTrip {
  Duration time;
};
struct TakeResult {
  msg::Result result;
};
struct TakeUnit {
  msg::Stepped result;
};
struct Finish {  // send what is queued, close; it counts as lost at once
  std::string reason;
};

using Action = std::variant<Send, Warn, Join, Heard, RoundTrip, TakeResult, TakeUnit, Finish>;

}  // namespace todo

enum class ClientState : uint8_t { connecting, syncing, building, ready, lost };

// What people want to know of a client.
struct ClientStatus {
  ClientState state = ClientState::connecting;
  double synced = 0;  // part of the scene that is there, 0..1
};

class ClientSession {
 public:
  static constexpr Duration kHelloWithin = std::chrono::seconds(5);
  static constexpr Duration kPingEvery = std::chrono::seconds(1);
  static constexpr Duration kDeadAfter = std::chrono::seconds(3);
  static constexpr Duration kDeadAfterInSync = std::chrono::seconds(10);

  ClientSession(ClientId id, std::string peer, const JobOffer& offer, StateKeeper& state,
                Admission& admission, Time now);

  void received(Message&& message, Time now);
  void tick(Time now);
  // The offer has a new job, and by `edits`, if there are any, another scene.
  void jobChanged(const std::vector<msg::Edit>& edits);
  // The method's state has a new version.
  void stateChanged(const std::vector<msg::StateDelta>& messages);
  // What it sent was malformed: it is told so and must not come back.
  void expel(const std::string& reason);
  void disconnected();

  std::vector<todo::Action> takeActions() { return std::exchange(actions_, {}); }

  const msg::Hello& hello() const { return hello_; }
  const std::string& peer() const { return peer_; }
  std::string title() const;  // for people: name and address
  const ClientStatus& status() const { return status_; }
  // It asks, and may fetch the scene to see how fast it comes; it gets no job.
  bool visits() const { return hello_.visits; }
  bool over() const { return status_.state == ClientState::lost; }
  bool ready() const { return status_.state == ClientState::ready; }
  // It has introduced itself.
  bool isInside() const { return !over() && status_.state != ClientState::connecting; }

 private:
  void on(msg::Hello&& m, Time now);
  void on(msg::BlobRequest&& m, Time now);
  void on(msg::Ready&& m, Time now);
  void on(msg::Progress&& m, Time now);
  void on(msg::Result&& m, Time now);
  void on(msg::Stepped&& m, Time now);
  void on(msg::Ping&& m, Time now);
  void on(msg::Pong&& m, Time now);
  void on(msg::Goodbye&& m, Time now);
  template <typename Other>
  void on(Other&&, Time);  // the master's own messages: decodeMessage lets none of them through

  void push(todo::Action action) { actions_.push_back(std::move(action)); }
  void send(Message message) { push(todo::Send{std::move(message)}); }
  void finish(const std::string& reason);

  const ClientId id_;
  const std::string peer_;
  const JobOffer& offer_;
  StateKeeper& state_;
  std::shared_ptr<const StateKeeper::Snapshot> offered_;  // until it is ready
  Admission& admission_;
  msg::Hello hello_;
  ClientStatus status_;
  std::vector<todo::Action> actions_;
  Time heard_, lastTick_, nextPing_;
  std::optional<Time> buildsSince_;
};

}  // namespace ninefold
