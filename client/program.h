// program.h: the client around its session: the connection, the workers and the builder, and
// nothing that decides. Carries the session's actions out and tells it what became of them.
//
// A task that does not end ends the process with kHungStatus and one line (watchdog.h).
//
// Threads: everything runs in the loop's thread; workers and builder post what they have to it.
// Owner: main. Errors: ends with a status and one line, see run.
#pragma once

#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <optional>

#include "client/master_address.h"
#include "client/options.h"
#include "client/result_group.h"
#include "client/scene_builder.h"
#include "client/session.h"
#include "client/watchdog.h"
#include "client/workers.h"
#include "proto/connection.h"
#include "proto/recording.h"
#include "proto/wire_level.h"

namespace ninefold::client {

// For tests: what happens before and after each task, on its thread, and how patient the watchdog
// is.
struct Rig {
  std::function<void(const FrameKey&, const msg::TaskItem&)> beforeTask = nullptr;
  std::function<void(msg::Result&)> afterTask = nullptr;
  std::function<void(msg::Stepped&)> afterUnit = nullptr;
  Duration grace = Watchdog::kGrace;
};

class Program {
 public:
  Program(EventLoop& loop, const Options& options, msg::Hello hello, std::shared_ptr<const Key> key,
          std::optional<BlobCache> cache, Rig rig = {});

  // Until the session ends; the exit status. Prints the last line.
  int run();

 private:
  void carryOut();
  void on(act::Connect&&);
  void on(act::Send&&);
  void on(act::Disconnect&&);
  void on(act::FindBlobs&& a) { builder_.ask(std::move(a)); }
  void on(act::KeepBlob&& a) { builder_.ask(std::move(a)); }
  void on(act::BuildScene a) { builder_.ask(a); }
  void on(act::EditScene&& a) { builder_.ask(std::move(a)); }
  void on(act::RestoreScene a) { builder_.ask(a); }
  void on(act::PrepareJob&& a) { builder_.ask(std::move(a)); }
  void on(act::StartTasks&& a) { startInTurn(std::move(a)); }
  void on(act::StartSteps&& a) { startInTurn(std::move(a)); }
  void on(act::CancelTasks&&);
  void on(act::CancelUnits&&);
  void on(act::Tell&&);
  void on(act::Exit&&);

  using Start = std::variant<act::StartTasks, act::StartSteps>;
  void startInTurn(Start&& start);
  void startEarly();
  // False when more wait than should.
  bool start(const act::StartTasks& tasks, const std::shared_ptr<RenderJob>& job);
  bool start(const act::StartSteps& steps, const std::shared_ptr<RenderJob>& job);
  void startConnection(std::shared_ptr<Connection> connection);
  // What all tasks of a message have in common.
  struct Order {
    uint32_t line;
    FrameKey frame;
    std::shared_ptr<const StatePages> state;
    float neighbourWeight;
    bool urgent;
    Duration allowed;
  };
  void runTask(RenderJob& job, const Order& order, const msg::TaskItem& item, int thread);
  void runUnit(const RenderJob& job, const act::StartSteps& steps, uint32_t unit, int thread);
  void add(ResultGroup::Finished&& finished);
  void handOver();
  void drop(const std::function<bool(uint32_t number, bool isStep)>& isVoid);
  bool keep(const Message& message);
  void keepRecording();
  void tick();
  // Runs `event` on the session in the loop's thread, and what follows from it.
  template <typename Event>
  void later(Event event);
  SceneBuilder::Answers answers();

  EventLoop& loop_;
  MasterAddress master_;
  const bool local_;
  const std::shared_ptr<const Key> key_;
  const std::unique_ptr<Recorder> recorder_;  // null: nothing is kept
  Session session_;
  std::shared_ptr<Connection> connection_;
  std::map<uint32_t, std::shared_ptr<RenderJob>> jobs_;  // the latest kJobsKept that are prepared
  std::deque<Start> early_;                              // whose job is being prepared
  std::unique_ptr<EventLoop::Timer> timer_;
  const int threads_;
  const Rig rig_;
  Watchdog watchdog_;
  ResultGroup results_;
  WireLevel wireLevel_;
  std::atomic<int> level_ = WireLevel::kLight;  // of the next results
  int status_ = 0;
  bool ending_ = false;
  SceneBuilder builder_;
  Workers workers_;
};

}  // namespace ninefold::client
