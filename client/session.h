// session.h: the client's side of the protocol as a pure value: messages, answers and the time go
// in, actions come out. No socket, thread, file or clock.
//
//   offline -> connecting -> greeting (Hello sent) -> syncing (fetch, build, prepare) -> ready
//
// Once ready it stays so: later jobs are prepared while tasks of earlier ones go on. Tasks may come
// before their job is prepared. A lost connection leads back to offline. A remote client then dials
// again, ever more rarely, and keeps its scene, which a restarted master need not send again. A
// local one ends, and its master starts another. Refuse and Goodbye end the program.
// Deadlines: Welcome, each piece of the scene, any sign of life of the master, patience without
// one.
// Errors: none thrown; a master that says something impossible is left.
// Use: call the event functions, then carry takeActions() out in order; tick() every 100 ms or so.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/actions.h"
#include "client/backoff.h"
#include "client/blob_fetch.h"
#include "client/state_store.h"
#include "common/base/clock.h"

namespace ninefold {

struct SessionOptions {
  msg::Hello hello;       // who we are
  std::string master;     // address, for lines to people
  bool reconnect = true;  // false: local client
  uint64_t seed = 0;      // of the backoff's random part
};

class Session {
 public:
  static constexpr Duration kWelcomeWithin = std::chrono::seconds(5);
  static constexpr Duration kPieceWithin = std::chrono::seconds(20);
  static constexpr Duration kMasterSilent = std::chrono::seconds(10);  // it pings every second
  static constexpr Duration kPatience = std::chrono::minutes(30);
  static constexpr Duration kProgressEvery = milliseconds(300);

  Session(SessionOptions options, Time now);

  // The connection.
  void connected(Time now);
  // `final`: trying again would not help (wrong key, no Ninefold master there).
  void connectFailed(const std::string& line, bool final, Time now);
  void disconnected(const std::string& reason, Time now);
  void received(Message&& message, Time now);

  // Answers to actions.
  void blobsFound(uint32_t load, std::vector<BlobInfo> missing, Time now);
  void sceneBuilt(uint32_t load, Time now);
  // False if it is a job of the past.
  bool jobPrepared(uint32_t load, uint32_t line, uint32_t jobVersion, Time now);
  void sceneFailed(uint32_t load, const std::string& line, Time now);
  void taskFinished(uint32_t line, msg::Result&& result, Time now);
  void unitFinished(uint32_t line, msg::Stepped&& result);
  void taskFailed(const std::string& line);
  // What the master sends cannot be kept.
  void recordingFailed(const std::string& line);
  void tasksRefused(Time now);  // more of them than our queue holds

  void tick(Time now);
  // The user wants the program to end.
  void stop(const std::string& reason);

  std::vector<act::Action> takeActions() { return std::exchange(actions_, {}); }

 private:
  enum class State : uint8_t { offline, connecting, greeting, syncing, ready, ended };
  enum class Scene : uint8_t { none, checking, fetching, building, built };

  bool online() const { return state_ == State::greeting || inside(); }
  bool inside() const { return state_ == State::syncing || state_ == State::ready; }

  void on(msg::Welcome&& m, Time now);
  void on(msg::Refuse&& m, Time now);
  void on(msg::SceneOffer&& m, Time now);
  void on(msg::BlobChunk&& m, Time now);
  void on(msg::Edit&& m, Time now);
  void on(msg::Configure&& m, Time now);
  void on(msg::Tasks&& m, Time now);
  void on(msg::Cancel&& m, Time now);
  void on(msg::Steps&& m, Time now);
  void on(msg::CancelSteps&& m, Time now);
  void on(msg::StateOffer&& m, Time now);
  void on(msg::StateDelta&& m, Time now);
  void on(msg::Ping&& m, Time now);
  void on(msg::Pong&&, Time) {}
  void on(msg::Goodbye&& m, Time now);
  template <typename Other>
  void on(Other&&, Time);  // the client's own messages: decodeMessage lets none of them through

  void checkTasks(const msg::Tasks& tasks) const;
  std::shared_ptr<const StatePages> pagesOf(uint32_t version) const;
  void continueFetch(Time now);
  void continueStateFetch(Time now);
  bool fetchesState() const { return scene_ == Scene::built && !states_.isWhole(); }
  void editScene(SceneEdit&& edit, bool moving, bool more = false);
  void prepare(const msg::Configure& job);
  const msg::Configure* findJob(uint32_t version) const;
  void sendProgress(Time now);
  void leave(const std::string& reason, Time now);  // on our own account
  void lost(const std::string& why, Time now);
  void end(int status, const std::string& line);
  void push(act::Action action) { actions_.push_back(std::move(action)); }
  void send(Message message) { push(act::Send{std::move(message)}); }

  const SessionOptions options_;
  std::vector<act::Action> actions_;
  State state_ = State::offline;
  Backoff backoff_;
  Time retryAt_;
  Time lastOnline_;  // patience counts from here
  Time lastTick_;
  std::string lastTrouble_;  // not told twice in a row
  uint32_t line_ = 0;        // counts connections
  Time heard_;               // last message of the master
  Time deadline_;            // of the greeting, or of the next piece

  // The scene, kept from one connection to the next.
  Scene scene_ = Scene::none;
  bool edited_ = false;  // the built scene is not as it was fetched
  EditsSoFar edits_;     // that wait for the scene to be built
  uint32_t load_ = 0;
  std::vector<BlobInfo> manifest_;
  uint32_t sceneVersion_ = 0;
  BlobFetch fetch_;
  Time nextProgress_;

  StateStore states_;                // of this connection
  std::deque<msg::Configure> jobs_;  // of this connection, the latest kJobsKept, oldest first
};

}  // namespace ninefold
